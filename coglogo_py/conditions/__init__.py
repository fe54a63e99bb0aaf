"""Conditions of cognitons: thresholds of an agent's fields that make them active or inactive."""
