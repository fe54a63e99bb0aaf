"""The figures of `farmer_artisan`, where they are described."""

from socialmind.catalogue import load_file, model_folder

draw = load_file(model_folder("farmer_artisan") / "figures.py").draw
