"""The figures of `collect`, where they are described."""

from socialmind.catalogue import load_file, model_folder

draw = load_file(model_folder("collect") / "figures.py").draw
