"""The studio: a local page that shows a society while it runs."""
