"""Who is near whom: agents within a radius, on patches, the nearest; any world with an extent."""
