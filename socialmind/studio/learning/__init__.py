"""The room of trainings: which there are, how far they came, and the best so far acting."""
