"""The tables of a run: columns, rows that wait, parts, merged files."""
