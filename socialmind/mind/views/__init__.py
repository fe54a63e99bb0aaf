"""What is to be seen of a mind: drawings, and the account of an evaluation."""
