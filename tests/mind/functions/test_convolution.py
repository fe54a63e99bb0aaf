"""Convolutional networks: the Avoid of figure A.2, and a small one on paper."""

import numpy as np
import pytest

from socialmind.errors import ModelError
from socialmind.mind import Skill
from socialmind.mind.functions.convolution import Convolution, Kernel


def avoid_inputs():
    """The inputs of figure A.2 with its elided lines filled in."""
    values = [f"{kind}S{k}{ticks}" for k in range(1, 11)
              for kind, ticks in (("SE:", ""), ("SH:", ":5"), ("SH:", ":10"))]  # fmt: skip
    return [*values, "SD:S1", "SD:S2", "SD:S10", "SE:DOF", "SD:DOF", "VA:VAR_TIME"]


def test_the_avoid_of_figure_a2_is_a_skill_of_732_weights(figure_a2):
    outputs = ["SK:moveForward", "SK:turnLeft", "SK:turnRight", "SK:moveBackwards"]
    avoid = Skill("Avoid", avoid_inputs(), outputs, figure_a2)
    assert len(avoid.inputs) == 36
    # Two kernels of 3 + 1; over 10 + 6 values 18 neurons a layer: 18 · 17 + 18 · 19 + 4 · 19.
    assert avoid.genome_size == 8 + 306 + 342 + 76


def test_each_kernel_of_figure_a2_reads_what_its_lines_say(figure_a2, stepped):
    network = figure_a2.network(36, 4)
    rng = np.random.default_rng(3)
    inputs = rng.random(36)
    genome = np.zeros(732)
    genome[0:4] = 0.5, 0.25, 0.125, 0.0  # a sensor now, 5 and 10 ticks ago
    genome[4:8] = 0.0, 0.0, 1.0, 0.0  # the last of a sensor and its two neighbours
    # The first hidden neurons copy neuron 9 of the spatial kernel and the last bypass.
    first, second, last = 8, 8 + 18 * 17, 8 + 18 * 17 + 18 * 19
    genome[first + 9] = 1.0
    genome[first + 17 + 15] = 1.0
    genome[second + 0] = genome[second + 19 + 1] = 1.0
    genome[last + 0] = genome[last + 19 + 1] = 1.0
    given = stepped(network, genome, [inputs])[0]
    # CONVO_LINK:1:9:9:0:1, its last place is neuron 1, of CONVO_LINK:0:1:3:4:5.
    neuron = 0.5 * inputs[3] + 0.25 * inputs[4] + 0.125 * inputs[5]
    assert given == pytest.approx([neuron, inputs[35], 0.0, 0.0], abs=1e-15)


def test_a_small_one_on_paper(stepped):
    kernel = Kernel(2, ((0, 1), (1, 2)))
    network = Convolution((kernel,), bypass=(3, 0), layers=0).network(4, 1)
    genome = [1.0, -1.0, 0.1, 0.5, 0.25, 2.0, 1.0, 0.05]
    # Neurons: 0.3 - 0.1 + 0.1 = 0.3 and max(0.1 - 0.9 + 0.1, 0) = 0; then 0.15 + 0 + 0.2 + 0.3.
    assert stepped(network, genome, [[0.3, 0.1, 0.9, 0.1]])[0] == pytest.approx([0.7], abs=1e-15)


def test_without_bypass_the_perceptron_reads_the_kernel_alone():
    kernel = Kernel(1, ((0,), (1,), (2,)))
    # 1 + 1 for the kernel; 5 neurons: 5 · 4 + 2 · 6.
    assert Convolution((kernel,), layers=1).genome_size(3, 2) == 2 + 20 + 12


def test_its_name(figure_a2):
    assert repr(figure_a2) == "a convolutional network of 2 kernels and 2 hidden layers"


ONE = Kernel(1, ((0,),))


@pytest.mark.parametrize(
    ("made", "expected"),
    [
        (
            lambda: Kernel(3, ((0, 1, 2), (1, 2))),
            "found 2 places linked to neuron 1 of a kernel of size 3; expected 3",
        ),
        (
            lambda: Kernel(0, ((),)),
            "found 0 as the number of inputs of a kernel; expected a whole number, 1 or more",
        ),
        (
            lambda: Kernel(1, ()),
            "found () as the links of a kernel; expected places for each neuron",
        ),
        (
            lambda: Kernel(1, (0, 1)),
            "found 0 as the places that neuron 0 of a kernel reads; expected a tuple of whole "
            "numbers",
        ),
        (
            lambda: Kernel(1, ((-1,),)),
            "found -1 as one of the places that neuron 0 of a kernel reads; expected a whole "
            "number, 0 or more",
        ),
        (
            lambda: Convolution(()),
            "found () as the kernels of a convolutional network; expected one or more",
        ),
        (
            lambda: Convolution((ONE, "two")),
            "found 'two' as a kernel of a convolutional network; expected a Kernel",
        ),
        (
            lambda: Convolution((ONE, Kernel(2, ((0, 1),)))),
            "found place 1 linked to neuron 0 of kernel 1; expected 0 … 0, a neuron of the kernel "
            "before",
        ),
        (
            lambda: Convolution((ONE,), bypass=(0.5,)),
            "found 0.5 as one of the inputs that bypass the kernels; expected a whole number, 0 "
            "or more",
        ),
        (
            lambda: Convolution((Kernel(2, ((0, 4),)),)).network(4, 1),
            "found place 4 linked to neuron 0 of kernel 0; expected 0 … 3, one of its 4 inputs",
        ),
        (
            lambda: Convolution((ONE,)).network(0, 1),
            "found place 0 linked to neuron 0 of kernel 0; expected an input; it has none",
        ),
        (
            lambda: Skill(
                "See", ["SE:S"], ["MO:M"], Convolution((ONE,), (1,)), None, "See.ades", 4
            ),
            "See.ades:4: found the skill 'See' with place 1 in the bypass; expected 0 … 0, one of "
            "its 1 inputs",
        ),
    ],
)
def test_refusals(made, expected):
    with pytest.raises(ModelError) as caught:
        made()
    assert str(caught.value) == expected
