"""Typing of calls: functions, draws, and what minds, populations and the world are asked."""
