"""Models that are functions of their parameters, with luck where it is asked for."""

import pytest

from socialmind.experiments import designs, sweep

FUNCTIONS = '''"""Functions of a model's parameters."""

import math

from socialmind import Agent, Model, Population, once, parameter


class Nobody(Agent):
    pass


def draw(model, rng):
    model.drawn = rng.normal(0.0, 1.0)


class Functions(Model):
    """What its measures are known to depend on."""

    a: float = parameter(0.0, low=-math.pi, high=math.pi)
    b: float = parameter(0.0, low=-math.pi, high=math.pi)
    c: float = parameter(0.0, low=-math.pi, high=math.pi)
    n: int = parameter(1, low=1, high=3)
    luck: float = parameter(0.0, low=0.0)
    word: str = parameter("low", choices=("low", "high"))
    broken: bool = parameter(False)
    drawn: float = 0.0
    nobody = Population(Nobody, 1)
    setup = (once(draw),)

    def series(self):
        a, b, c = self.a, self.b, self.c
        lift = 5.0 if self.word == "high" else 0.0
        return {
            "ishigami": math.sin(a) + 7 * math.sin(b) ** 2 + 0.1 * c**4 * math.sin(a),
            "linear": 3 * a + 2 * b + lift + self.luck * self.drawn,
            "whole": 10.0 * self.n + a,
            "square": a * a,
            "nothing": 4,
            "hole": math.nan if self.broken or a > 3 else a,
        }
'''
RANGES = dict.fromkeys("abc", (-3.141592653589793, 3.141592653589793))


@pytest.fixture(scope="session")
def functions(tmp_path_factory):
    """The folder of the model."""
    folder = tmp_path_factory.mktemp("functions") / "functions"
    folder.mkdir()
    (folder / "model.py").write_text(FUNCTIONS)
    return folder


@pytest.fixture(scope="session")
def swept(functions, tmp_path_factory):
    """Sweep the model over a design; gives the sweep's folder."""

    def over(design, **options):
        out = tmp_path_factory.mktemp("swept") / "sweep"
        given = {"ticks": 0, "every": 0, "compiled": False, "workers": 1, "out": out}
        return sweep(functions, design, **(given | options))

    return over


@pytest.fixture(scope="session")
def sobol_sweep(swept):
    """The functions over Saltelli's design."""
    return swept(designs.saltelli(RANGES, 128))
