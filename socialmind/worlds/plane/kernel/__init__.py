"""The compiled kernel of the plane: motion, contacts and range finders."""
