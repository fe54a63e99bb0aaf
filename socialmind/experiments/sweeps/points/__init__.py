"""The points of a design: what a column can name, what its values set, the table of all."""
