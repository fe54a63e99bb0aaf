"""What a page plots, as files: figures in the house style, and tables."""
