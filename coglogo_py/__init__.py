"""The cogniton engine: schemes, minds, groups and culturons, decision makers."""
