"""Methods of fitting: who says which trials are made next, given how far the others were."""
