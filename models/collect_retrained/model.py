"""The robot of `collect` whose skill Avoid was learned anew while Collect steered (thesis, 6.2).

The world is that of `collect`; the mind is what differs.
"""

from socialmind.catalogue import load_file, model_folder

COLLECT = load_file(model_folder("collect") / "model.py")


class CollectRetrained(COLLECT.Collect):
    """A robot, an object, a drop zone and a field of obstacles."""
