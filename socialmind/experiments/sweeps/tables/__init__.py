"""The tables of a sweep: rows that runs recorded, parts on disk, and one sorted file each."""
