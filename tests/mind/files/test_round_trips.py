"""What is written reads back as equal: minds as folders and as YAML, tasks, weights to the bit."""

import math
import tempfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from small_mind import FILES, YAML_MIND, small_description

from coglogo_py import CognitiveScheme, Cogniton
from socialmind.errors import ModelError
from socialmind.mind import (
    Actuator,
    Counter,
    MindDescription,
    Programmed,
    Sensor,
    Simple,
    Skill,
    Variable,
    Wave,
)
from socialmind.mind.files.evoagents import genome_file, simbatch
from socialmind.mind.files.folder import load_tasks, save_tasks
from socialmind.mind.functions.cogniton_scheme import CognitonScheme
from socialmind.mind.functions.convolution import Convolution, Kernel
from socialmind.mind.functions.elman import Elman
from socialmind.mind.functions.influence_network import InfluenceNetwork
from socialmind.mind.functions.neat.graph import GraphNeuron, NeatGraph
from socialmind.mind.functions.perceptron import Perceptron
from socialmind.mind.functions.recurrent import Recurrent

FORMS = ["mind", "mind.yaml"]
"""A folder and a YAML file."""


def facts(mind):
    """All that a mind says, to be compared; functions by name, since each loading makes its own."""
    return (
        mind.name,
        dict(mind.sensors),
        dict(mind.actuators),
        {name: _variable(one) for name, one in mind.variables.items()},
        {name: _skill(one) for name, one in mind.skills.items()},
    )


def _variable(variable):
    function = getattr(variable.regulation, "function", None)
    regulation = variable.regulation if function is None else function.__name__
    return regulation, variable.default, variable.group


def _skill(skill):
    function = skill.function
    if isinstance(function, Programmed):
        function = function.name
    if isinstance(function, CognitonScheme):
        function = (function.scheme, dict(function.cognitons))
    genome = None if skill.genome is None else skill.genome.tobytes()
    return skill.inputs, skill.outputs, function, genome


LETTERS = st.characters(exclude_categories=("Cs", "Cc"), exclude_characters=":#/\\\ufeff")
TEXTS = st.text(LETTERS, max_size=8).map(str.strip)
NAMES = TEXTS.filter(lambda text: text and text[0] != ".")
SHARES = st.floats(0, 1)
WEIGHTS = st.floats(allow_nan=False, allow_infinity=False)
HIDDEN = {
    "layers": st.integers(1, 3),
    "hidden": st.sampled_from(["relu", "sigmoid"]),
    "added": st.integers(0, 2),
}


def _variables(name):
    return st.one_of(
        st.builds(Variable, st.just(name), st.just(Simple()), st.none() | SHARES, st.none()),
        st.builds(Variable, st.just(name), st.just(Simple()), st.none() | SHARES, NAMES),
        st.builds(Variable, st.just(name), st.just(Wave())),
        st.tuples(st.integers(1, 20), SHARES, SHARES).map(
            lambda values: Variable(name, Counter(values[0], max(values[1:]), min(values[1:])))
        ),
    )


@st.composite
def _convolutions(draw, inputs):
    kernels = []
    below = inputs
    for _ in range(draw(st.integers(1, 2))):
        size = draw(st.integers(1, 3))
        places = st.tuples(*[st.integers(0, below - 1)] * size)
        kernels.append(Kernel(size, tuple(draw(st.lists(places, min_size=1, max_size=3)))))
        below = kernels[-1].neurons
    bypass = draw(st.lists(st.integers(0, inputs - 1), max_size=2))
    fields = draw(st.fixed_dictionaries(HIDDEN))
    return Convolution(kernels=tuple(kernels), bypass=tuple(bypass), **fields)


def _functions(inputs, outputs):
    plain = [st.builds(kind, **HIDDEN) for kind in (Perceptron, Elman, Recurrent)]
    kinds = [
        *plain,
        st.just(NeatGraph()),
        st.just(NeatGraph.minimal(inputs, outputs)),
        st.builds(
            InfluenceNetwork,
            branches=st.integers(1, 3),
            passes=st.just((0,) if inputs else ()),
            gates=st.sampled_from(["output", "branch"]),
            **HIDDEN,
        ),
    ]
    return st.one_of(*kinds, *([_convolutions(inputs)] if inputs else []))


@st.composite
def minds(draw):
    names = st.lists(NAMES, min_size=1, max_size=3, unique=True)
    sensors = [
        Sensor(name, draw(TEXTS), tuple(draw(st.lists(TEXTS, max_size=2)))) for name in draw(names)
    ]
    actuators = [
        Actuator(name, draw(TEXTS), draw(SHARES), tuple(draw(st.lists(TEXTS, max_size=1))))
        for name in draw(names)
    ]
    variables = [draw(_variables(name)) for name in draw(names)]
    readable = [f"SE:{one.name}" for one in sensors] + [f"SH:{one.name}:7" for one in sensors]
    readable += [f"VD:{one.name}" for one in variables]
    writable = [f"MO:{one.name}" for one in actuators] + [f"VA:{one.name}" for one in variables]
    skills = []
    for name in draw(names):
        inputs = draw(st.lists(st.sampled_from(readable), max_size=4))
        below = [f"SK:{one.name}" for one in skills]
        outputs = draw(
            st.lists(st.sampled_from(writable + below), min_size=1, max_size=3, unique=True)
        )
        skill = Skill(name, inputs, outputs, draw(_functions(len(inputs), len(outputs))))
        if draw(st.booleans()):
            size = skill.genome_size
            few = draw(st.lists(WEIGHTS, min_size=1, max_size=5))
            skill = skill.changed(genome=np.resize(few, size))
        skills.append(skill)
    return MindDescription(draw(NAMES), sensors, actuators, variables, skills)


@pytest.mark.parametrize("form", FORMS)
@settings(max_examples=40, suppress_health_check=[HealthCheck.too_slow])
@given(mind=minds())
def test_a_mind_reads_back_as_equal(form, mind):
    with tempfile.TemporaryDirectory() as home:
        path = Path(home) / form
        mind.save(path)
        read = MindDescription.load(path)
        assert facts(read) == facts(mind)
        assert read == mind and hash(read) == hash(mind)
        # Saving over it changes nothing, and leaves nothing behind.
        before = _contents(home)
        read.save(path)
        assert facts(MindDescription.load(path)) == facts(mind)
        assert _contents(home).keys() == before.keys()


def _contents(folder):
    files = sorted(path for path in Path(folder).rglob("*") if path.is_file())
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


@pytest.mark.parametrize("form", FORMS)
def test_a_mind_with_programs_and_schemes_moves_house(write_files, tmp_path, form):
    mind = MindDescription.load(write_files(FILES))
    before = _contents(tmp_path / "mind")
    mind.save(tmp_path / "other" / form)
    moved = MindDescription.load(tmp_path / "other" / form)
    assert facts(moved) == facts(mind)
    assert moved.skill("Turn").function.function(0.25) == (0.25, 0.75)
    assert moved.variables["LEAK"].regulation.function(1.0, 0.5) == pytest.approx(0.55)
    assert _contents(tmp_path / "mind") == before
    # And from there into the first form again.
    moved.save(tmp_path / "third")
    assert facts(MindDescription.load(tmp_path / "third")) == facts(mind)


def test_saving_a_folder_into_itself_keeps_programs_and_schemes(write_files):
    folder = write_files(FILES | {"Skills/Think/think.yaml": "# mine\n" + FILES[THINK]})
    before = _contents(folder)
    MindDescription.load(folder).save(folder)
    after = _contents(folder)
    assert after.keys() == before.keys()
    for name in (THINK, "Robot.py", "Skills/Turn/TurnRound.py"):
        assert after[name] == before[name]


THINK = "Skills/Think/think.yaml"


def test_the_yaml_form_says_what_the_folder_says(write_files, tmp_path):
    mind = MindDescription.load(write_files({"robot.yaml": YAML_MIND}) / "robot.yaml")
    assert mind.sensors["S2"].parameters == ("2",)
    assert mind.actuators["MotR"].neutral == 0.25
    assert mind.variables["N"].regulation == Counter(5, 0.9, 0.1)
    assert mind.variables["ALARM"].group == "Herd"
    assert mind.skill("Master").function == Perceptron(layers=1, hidden="sigmoid")
    kernel = Kernel(2, ((0, 1), (1, 2)))
    assert mind.skill("See").function == Convolution((kernel,), bypass=(3,), layers=0)
    assert [one.line for one in mind.skill("See").inputs] == [18] * 4
    mind.save(tmp_path / "folder")
    assert facts(MindDescription.load(tmp_path / "folder")) == facts(mind)


def test_sensors_may_be_a_list_of_names(write_files):
    text = "name: m\nsensors: [A, B]\nactuators: [M]\nvariables: [V]\n"
    mind = MindDescription.load(write_files({"m.yaml": text}) / "m.yaml")
    assert list(mind.sensors) == ["A", "B"]
    assert mind.variables["V"] == Variable("V")


@given(
    genome=st.lists(WEIGHTS, min_size=4, max_size=4),
)
def test_weights_read_back_to_the_bit(genome):
    skill = Skill("Go", ["SE:S"], ["MO:M", "MO:N"], Perceptron(layers=0), genome)
    read = genome_file.parse(genome_file.written(skill), "Go.genome", skill.changed(genome=None))
    assert read.genome.tobytes() == np.array(genome).tobytes()


def test_weights_at_the_ends_of_doubles():
    ends = [-0.0, 5e-324, 1.7976931348623157e308, 0.1 + 0.2]
    skill = Skill("Go", ["SE:S"], ["MO:M", "MO:N"], Perceptron(layers=0), ends)
    read = genome_file.parse(genome_file.written(skill), "Go.genome", skill.changed(genome=None))
    assert read.genome.tolist() == ends
    assert math.copysign(1, read.genome[0]) == -1


def test_a_neat_graph_travels_with_its_weights(tmp_path):
    small_description().save(tmp_path / "mind")
    skill_file = (tmp_path / "mind" / "Skills" / "Go" / "Go.ades").read_text()
    assert skill_file.endswith("neural\nTYPE:NEAT\n")
    go = MindDescription.load(tmp_path / "mind").skill("Go")
    assert go.function.neurons == (GraphNeuron(1, (-1, -2), "tanh"), GraphNeuron(0, (1,)))
    (tmp_path / "mind" / "Skills" / "Go" / "Go.genome").unlink()
    assert MindDescription.load(tmp_path / "mind").skill("Go").function == NeatGraph()


def test_a_neat_graph_without_weights_stands_in_the_skill(tmp_path):
    mind = small_description()
    bare = mind.with_modules(skills=[mind.skill("Go").changed(genome=None)])
    for form in FORMS:
        bare.save(tmp_path / form)
        assert facts(MindDescription.load(tmp_path / form)) == facts(bare)


@given(
    st.builds(
        simbatch.Task,
        st.sampled_from(simbatch.TYPES),
        **dict.fromkeys(simbatch.TEXTS.values(), TEXTS),
        **{name: st.none() | st.integers(0, 10**9 - 1) for name in simbatch.NUMBERS.values()},
        others=st.dictionaries(
            NAMES.filter(lambda key: key not in ("TYPE", *simbatch.TEXTS, *simbatch.NUMBERS)),
            st.text(LETTERS | st.just(":"), max_size=5).map(str.strip),
            max_size=2,
        ),
    )
)
def test_a_task_reads_back_as_equal(task):
    assert simbatch.parse(simbatch.written(task), "t.simbatch") == task


def test_tasks_are_saved_beside_the_skills(tmp_path):
    tasks = {"Go": simbatch.Task("OPENENDED", others={"SPEED": "2"})}
    save_tasks(tasks, tmp_path)
    assert load_tasks(tmp_path) == tasks


def test_a_scheme_of_a_program_gets_a_file_of_its_own(tmp_path):
    hunger = Cogniton("Hunger", influence={"Eat": 1.0}, conditional=("Eat",))
    chooser = CognitonScheme(CognitiveScheme("chooser", (hunger,)), {"SE:Gut": "Hunger"})
    eat = Skill("Eat", (), ["MO:Jaw"], Perceptron(layers=0))
    mind = MindDescription(
        "cow", ["Gut"], ["Jaw"], skills=[Skill("Choose", ["SE:Gut"], ["SK:Eat"], chooser), eat]
    )
    for form in FORMS:
        mind.save(tmp_path / form)
        assert facts(MindDescription.load(tmp_path / form)) == facts(mind)
    assert (tmp_path / "mind" / "Skills" / "Choose" / "Choose.yaml").is_file()


NAMELESS = Programmed(lambda: 1.0)


def _refused(mind, path):
    with pytest.raises(ModelError) as caught:
        mind.save(path)
    return str(caught.value)


def test_nothing_is_saved_over_another_mind(tmp_path):
    mind = small_description()
    mind.save(tmp_path / "mind")
    before = _contents(tmp_path)
    fewer = MindDescription("small", ["S1"], ["M"], ["X"], [mind.skill("Go")])
    assert "Skills/Top: found Top, which is not of the mind" in _refused(fewer, tmp_path / "mind")
    bare = mind.with_modules(skills=[mind.skill("Go").changed(genome=None)])
    assert "Go.genome, which is not of the mind" in _refused(bare, tmp_path / "mind")
    other = MindDescription("other", ["S1"], ["M"], ["X"], mind.skills.values())
    assert "small.botdesc" in _refused(other, tmp_path / "mind")
    assert _contents(tmp_path) == before
    mind.save(tmp_path / "mind.yaml")
    assert "weights of its skills only" in _refused(bare, tmp_path / "mind.yaml")


@pytest.mark.parametrize(
    ("mind", "words"),
    [
        (MindDescription("../out"), "'../out' as the name of a file"),
        (MindDescription("m", [Sensor("S", "a:b")]), "'a:b' as the type of the sensor 'S'"),
        (MindDescription("m", [Sensor("S", "a\nb")]), "control characters"),
        (MindDescription("m", (), [Actuator("M", "a", 0.5, ("#",))]), "a parameter of the act"),
        (MindDescription("m", variables=[Variable("V", Wave(), None, "Herd")]), "share a simple"),
        (
            MindDescription("m", (), ["M"], skills=[Skill(".", (), ["MO:M"], Elman())]),
            "does not begin with '.'",
        ),
        (
            MindDescription(
                "m", (), ["M"], skills=[Skill("a", (), ["MO:M"], Programmed(lambda: 1.0))]
            ),
            "a plain function",
        ),
    ],
    ids=["path", "colon", "two-lines", "comment", "shared-wave", "dot", "lambda"],
)
def test_what_a_folder_cannot_hold_is_refused_before_anything_is_written(tmp_path, mind, words):
    message = _refused(mind, tmp_path / "mind")
    assert words in message
    assert "\n" not in message
    assert not (tmp_path / "mind").exists()


def test_a_place_that_cannot_be_written_is_one_line(tmp_path):
    (tmp_path / "mind").write_text("a file")
    message = _refused(small_description(), tmp_path / "mind" / "in")
    assert message.startswith(str(tmp_path / "mind"))
    assert "cannot be written" in message


def test_minds_are_equal_that_are_written_alike(write_files, tmp_path):
    mind = MindDescription.load(write_files(FILES))
    mind.save(tmp_path / "saved.yaml")
    assert MindDescription.load(tmp_path / "saved.yaml") == mind
    learner = next(one for one in mind.skills.values() if one.genome_size)
    other = mind.with_modules(skills=[learner.changed(genome=np.full(learner.genome_size, 0.25))])
    assert other != mind
    assert mind != "mind"


def test_functions_that_cannot_be_written_are_like_no_others():
    def robot():
        skill = Skill("Turn", ["SE:Far"], ["MO:MotL"], Programmed(lambda far: far))
        return MindDescription("robot", ["Far"], ["MotL"], skills=[skill])

    one = robot()
    assert one == one and one != robot()
