"""Trainings as folders: attempts, safe on disk after every generation."""
