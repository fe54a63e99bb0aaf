"""The kinds of network by the keywords of `.ades` files and YAML (thesis, A.3.1: TYPE)."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from socialmind.mind.functions.contract import InternalFunction
from socialmind.mind.functions.convolution import Convolution
from socialmind.mind.functions.elman import Elman
from socialmind.mind.functions.influence_network import InfluenceNetwork
from socialmind.mind.functions.neat.graph import NeatGraph
from socialmind.mind.functions.perceptron import Perceptron
from socialmind.mind.functions.recurrent import Recurrent

NETWORKS: Mapping[str, type[InternalFunction]] = MappingProxyType(
    {
        kind.keyword: kind
        for kind in (Perceptron, Convolution, Elman, Recurrent, NeatGraph, InfluenceNetwork)
    }
)
"""The trainable internal functions by keyword."""
