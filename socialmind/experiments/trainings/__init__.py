"""Trainings as plans: made from nothing or from what is kept, and rechecked."""
