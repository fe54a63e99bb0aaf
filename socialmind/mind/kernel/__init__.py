"""The evaluation of hierarchies as compiled functions over arrays; see `kernel.layout`."""
