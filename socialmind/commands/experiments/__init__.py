"""The commands of experiments: many runs, what they come to, and what they say."""
