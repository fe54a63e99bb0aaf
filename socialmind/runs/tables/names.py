"""The names of tables."""

SERIES = "series"
AGENTS = "agents"
GROUPS = "groups"
TABLES = (SERIES, AGENTS)
"""The tables that every run has."""
LINKS = "links"
EVENTS = "events"
FURTHER = (GROUPS, LINKS, EVENTS)
"""Those that a run has from its beginning, or never: of models whose minds can form groups, of
those whose links are to be recorded, and of those in whose ticks agents are born or die."""
