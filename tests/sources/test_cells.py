"""Models that were typed in: into a kernel's cells, IPython, `python -c`, a prompt."""

import subprocess
import sys
from pathlib import Path

import pytest

from socialmind.experiments import replay

AGENTS = """
import math
from socialmind import Agent, Model, Population, each, parameter
from socialmind.experiments import Run, Sweep, designs, replay, run, sweep

class Walker(Agent):
    far: float = 1.0
"""
HELPERS = """
STEP = 2.0
N = 3

def twice(x):
    return 2 * x
"""
RULE = """
def walk(walker, model):
    walker.far += math.sqrt(twice(STEP)) * model.speed  # 2 a tick
"""
MODEL = """
class Walk(Model):
    speed: float = parameter(1.0)
    walkers = Population(Walker, N)
    schedule = (each(walkers, walk),)
"""
FAR = """
def far(ticks=1):
    society = Walk(compiled=False)
    society.advance(ticks)
    return society.walkers.far.tolist()
far()
"""


class Kernel:
    """Cells that are executed one after another by a kernel of Jupyter.

    Args:
        folder: the working folder.
    """

    def __init__(self, folder):
        from jupyter_client.manager import start_new_kernel

        self.manager, self.client = start_new_kernel(kernel_name="python3", cwd=str(folder))

    def __call__(self, text, timeout=300):
        """Execute a cell, and return what it gave, printed or raised."""
        found = []

        def hear(message):
            content = message["content"]
            if message["msg_type"] == "execute_result":
                found.append(content["data"]["text/plain"])
            elif message["msg_type"] == "stream":
                found.append(content["text"].strip())
            elif message["msg_type"] == "error":
                found.append(f"{content['ename']}: {content['evalue']}")

        self.client.execute_interactive(text, output_hook=hear, timeout=timeout)
        return found[-1] if found else None

    def end(self):
        self.client.stop_channels()
        self.manager.shutdown_kernel(now=True)


@pytest.fixture(scope="module")
def shared_kernel(tmp_path_factory):
    pytest.importorskip("ipykernel", reason="a kernel needs ipykernel")
    kernel = Kernel(tmp_path_factory.mktemp("kernel"))
    yield kernel
    kernel.end()


@pytest.fixture
def kernel(shared_kernel):
    shared_kernel("%reset -f")
    for text in (AGENTS, HELPERS, RULE, MODEL):
        assert shared_kernel(text) is None
    assert shared_kernel(FAR) == "[3.0, 3.0, 3.0]"
    return shared_kernel


def test_cells_run_at_both_speeds(kernel):
    assert kernel("slow, fast = Walk(compiled=False), Walk()") is None
    kernel("slow.advance(5); fast.advance(5)")
    assert kernel("slow.walkers.far.tolist() == fast.walkers.far.tolist()") == "True"


def test_what_rules_read_is_followed_at_once(kernel):
    kernel("STEP = 8.0")
    assert kernel("far()") == "[5.0, 5.0, 5.0]"
    kernel("def twice(x):\n    return x / 2")
    assert kernel("far()") == "[3.0, 3.0, 3.0]"


@pytest.mark.parametrize(
    ("cell", "name", "after"),
    [
        (RULE.replace("+=", "-="), "walk", "[-1.0, -1.0, -1.0]"),
        ("N = 2", "N", "[3.0, 3.0]"),
        ("class Walker(Agent):\n    far: float = 7.0", "Walker", "[9.0, 9.0, 9.0]"),
    ],
)
def test_a_class_that_holds_what_was_written_anew_is_refused(kernel, cell, name, after):
    kernel(cell)
    said = kernel("far()")
    assert f"found {name}, which was written anew since the class Walk was made" in said
    assert "run the cell of class Walk again" in said
    assert name != "walk" or "ModelError: cell In[" in said
    assert kernel(MODEL) is None
    assert kernel("far()") == after


def test_a_cell_that_is_run_again_unchanged_changes_nothing(kernel):
    for text in (RULE, HELPERS, AGENTS):
        kernel(text)
        assert kernel("far()") == "[3.0, 3.0, 3.0]"


def test_two_classes_of_one_name_stay_two(kernel):
    kernel("old = Walk; before = Walk(compiled=False)")
    kernel(MODEL.replace("parameter(1.0)", "parameter(3.0)"))
    assert kernel("far()") == "[7.0, 7.0, 7.0]"
    kernel("before.advance(1); after = old(compiled=False); after.advance(1)")
    assert kernel("[*before.walkers.far, *after.walkers.far] == [3.0] * 6") == "True"


def test_errors_name_cell_and_line(kernel):
    kernel("def walk(walker, model):\n    walker.far = 1 / (walker.far - 1)")
    kernel(MODEL)
    place = kernel("print(In[-2].count('1 /'), len(In) - 3)").split()
    assert f"RuleError: cell In[{place[1]}], line 2: ZeroDivisionError" in kernel("far()")
    kernel("def walk(walker, model):\n    walker.fur = 1")
    kernel(MODEL)
    assert kernel("far()").startswith(f"ModelError: cell In[{int(place[1]) + 4}], line 2: ")
    assert kernel(
        "made = sweep(Walk, ticks=2, workers=2, compiled=False)\nprint(Sweep(made).runs.error[0])"
    ).startswith("SocialmindError: cell In[")


def test_a_sweep_takes_them_to_other_processes(kernel):
    kernel("import numpy as np\nWEIGHTS = np.array([1.0, 2.0, 3.0])")
    kernel("def weighed(model):\n    return float((model.walkers.far * WEIGHTS).sum())")
    said = kernel(
        "made = sweep(Walk, designs.grid({'speed': [1.0, 2.0]}), ticks=1, workers=2,"
        " compiled=False, measures={'weighed': weighed})\n"
        "print(Sweep(made).runs[['speed', 'weighed']].to_numpy().tolist())"
    )
    assert said == "[[1.0, 18.0], [2.0, 30.0]]"


def test_what_cannot_go_there_is_named(kernel):
    kernel("import threading\nLOCK = threading.Lock()")
    kernel("def locked(model):\n    return LOCK is None")
    said = kernel("sweep(Walk, ticks=1, workers=2, compiled=False, measures={'m': locked})")
    assert "what other processes cannot load" in said and "lock" in said


MINDED = """
from coglogo_py import CognitiveScheme, Cogniton

SCHEME = CognitiveScheme("folk", (Cogniton("Need", conditional=("go",), start_value=2),))

def go(walker):
    walker.far += walker.mind.get_cogniton_value("Need")

def act(walker, model, rng):
    walker.plan = walker.mind.choose_next_plan()
    walker.run_plan(model, rng)

class Walk(Model):
    walkers = Population(Walker, 3, mind=SCHEME, plans={"go": go})
    schedule = (each(walkers, act),)
"""


def test_a_scheme_of_cells_goes_along_and_is_kept(kernel, tmp_path):
    kernel(MINDED)
    assert kernel("far()") == "[3.0, 3.0, 3.0]"
    said = kernel("print(Sweep(sweep(Walk, ticks=1, workers=2, compiled=False)).runs.status[0])")
    assert said == "finished"
    out = tmp_path / "run"
    kernel(f"run(Walk, 2, compiled=False, out={str(out)!r})")
    assert "CognitiveScheme.parsed(" in (out / "source/model/cells.py").read_text()
    assert replay(out).exact and replay(out).equal
    kernel(MINDED.replace("start_value=2", "start_value=4").partition("def go")[0])
    assert "found SCHEME, which was written anew" in kernel("far()")


def test_a_cell_under_time_is_refused_with_a_way_out(kernel):
    kernel(f"%%time\n{RULE}{MODEL}")
    said = kernel("far()")
    assert "whose text Python did not keep" in said and "without %%time" in said


def test_a_lambda_and_a_class_made_of_its_namesake_are_refused_there(kernel):
    asked = "ticks=1, workers=2, compiled=False"
    said = kernel(f"sweep(Walk, {asked}, measures={{'m': lambda model: 1}})")
    assert said.startswith("ModelError: cell In[") and "found a lambda" in said
    kernel("class Walk(Walk):\n    ticks = 3")
    assert kernel("far()") == "[3.0, 3.0, 3.0]"
    assert "Walk, which is made of another Walk" in kernel(f"sweep(Walk, {asked})")


def test_a_run_of_them_is_replayed_by_the_command_line(kernel, tmp_path):
    out = tmp_path / "run"
    assert kernel(f"run(Walk, 4, compiled=False, out={str(out)!r}).name") == "'run'"
    done = subprocess.run(
        [sys.executable, "-m", "socialmind", "replay", str(out)], capture_output=True, text=True
    )
    assert (done.stdout, done.returncode) == ("equal\n", 0), done.stderr
    kept = (out / "source/model/cells.py").read_text()
    assert kept.splitlines()[0] == "import math"
    assert "STEP = 2.0" in kept and "def far(" not in kept
    kernel("STEP = 8.0")
    assert kernel(f"print(replay({str(out)!r}).equal)") == "True"
    assert kernel(f"print(replay({str(out)!r}, model_class=Walk).equal)") == "False"


def test_modules_that_are_edited_under_autoreload_are_followed(kernel, tmp_path):
    file = tmp_path / "paces.py"
    file.write_text("def pace():\n    return 3.0\n")
    kernel(f"import sys\nsys.path.insert(0, {str(tmp_path)!r})")
    kernel("%load_ext autoreload\n%autoreload 2\nimport paces")
    kernel("def twice(x):\n    return paces.pace() ** 2")
    assert kernel("far()") == "[4.0, 4.0, 4.0]"
    file.write_text("# moved by a line, and edited\n\ndef pace():\n    return 5.0\n")
    assert kernel("far()") == "[6.0, 6.0, 6.0]"


def test_compiled_code_does_not_pile_up_with_cells(kernel):
    count = "len([*cache_folder().rglob('*')])"
    kernel("from coglogo_py.compiled.code_folder import cache_folder")
    kernel("Walk().advance(1)")
    before = kernel(count)
    for text in ("# another cell\n" + RULE, "\n\n" + MODEL):
        kernel(text)
        kernel("Walk().advance(1)")
    assert kernel(count) == before


# Without a kernel ---------------------------------------------------------------------------------

WHOLE = AGENTS + HELPERS + RULE + MODEL
SHOW = """
for compiled in (False, True):
    society = Walk(compiled=compiled); society.advance(2); print(society.walkers.far.tolist())

"""


def python(*arguments, said=None):
    done = subprocess.run(
        [sys.executable, *arguments], input=said, capture_output=True, text=True, timeout=300
    )
    return done.stdout, done.stderr


def test_python_c_runs_them_at_both_speeds():
    out, error = python("-c", WHOLE + SHOW)
    assert out == "[5.0, 5.0, 5.0]\n" * 2, error
    out, error = python(
        "-Ic", f"import sys; sys.path.insert(0, {str(Path.cwd())!r})\n{WHOLE}{SHOW}"
    )
    assert out == "[5.0, 5.0, 5.0]\n" * 2, error


def test_python_c_takes_them_to_other_processes(tmp_path):
    asked = f"ticks=1, workers=2, compiled=False, out={str(tmp_path / 'made')!r}"
    last = f"print(Sweep(sweep(Walk, {asked})).runs.status[0])"
    out, error = python("-c", f"{WHOLE}\n{last}")
    assert out == "finished\n", error


@pytest.mark.parametrize("arguments", [("-",), ("-i", "-q")])
@pytest.mark.skipif(sys.version_info >= (3, 13), reason="later prompts keep what is typed")
def test_what_python_does_not_keep_is_refused_with_a_way_out(arguments):
    typed = f"{WHOLE}\nWalk(compiled=False)\n"
    _, error = python(*arguments, said=typed)
    assert "found the rule 'walk', whose text Python did not keep" in error
    assert "save the model in a file and run that, or paste it into `ipython`" in error


def test_ipython_in_a_terminal_runs_them():
    pytest.importorskip("IPython")
    typed = "".join(
        f"exec_cell = get_ipython().run_cell({text!r})\n" for text in (AGENTS, HELPERS, RULE, MODEL)
    )
    out, error = python(
        "-m", "IPython", "--simple-prompt", "-i", said=f"{typed}{FAR[:-6]}\n\nfar()\n"
    )
    assert "[3.0, 3.0, 3.0]" in out, error
