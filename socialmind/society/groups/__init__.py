"""Who is in an instance of a group, and who asks to be: sets for rules at both speeds."""
