"""CogLogo's scheme files: its own files and recorded cases, the grammar's corners, the errors."""

import json
import warnings
from dataclasses import replace

import pytest

from coglogo_py import (
    BiasedWeightedStochastic,
    CognitiveScheme,
    Cogniton,
    Culturon,
    Group,
    MaximumWeight,
    Role,
    SchemeError,
)
from coglogo_py.files.cogscheme_file import parse, written

HEAD = "STARTCS\ncows\nMaximumWeight 1.0\nBREEDS\n"
BASE = (
    "COG\nbase\n-8355712\ntrue\n2.0\nINFLUENCE\neat=1.5\nDEPENDENCY\neat\nREINFORCEMENT\neat=0.5\n"
)


def read(text):
    return parse(text, "cows.cogscheme", CognitiveScheme)


def with_base(more=""):
    """The scheme of one cogniton; `more` stands before ENDCS."""
    return read(HEAD + BASE + more + "ENDCS\n")


BASE_COGNITON = Cogniton(
    "base", True, 2.0, influence={"eat": 1.5}, conditional=("eat",), reinforcement={"eat": 0.5}
)


def colour_of(rgb):
    return (rgb >> 16 & 255, rgb >> 8 & 255, rgb & 255)


def expected_cogniton(parsed):
    return Cogniton(
        parsed["name"],
        parsed["starting"],
        parsed["starting_value"],
        colour_of(parsed["color_rgb"]),
        parsed["pos"],
        parsed["influence"],
        parsed["dependency"],
        parsed["reinforcement"],
    )


def expected_group(parsed):
    return Group(
        parsed["group"],
        [
            Role(
                role["role"],
                [
                    Culturon(
                        culturon["name"],
                        culturon["starting_value"],
                        colour_of(culturon["color_rgb"]),
                        culturon["pos"],
                        culturon["influence"],
                        culturon["dependency"],
                        culturon["reinforcement"],
                    )
                    for culturon in role["culturons"]
                ],
            )
            for role in parsed["roles"]
        ],
    )


MENDED = {
    "no maker line: BREEDS becomes the maker",
    "repeated cogniton",
    "groups without any cogniton: misread",
}


def test_recorded_cases_read_as_coglogo_read_them(shared_data):
    cases = json.loads(shared_data("cogscheme_vectors.json").read_text())
    agreed = refused = 0
    for case in cases:
        parsed = case["parsed"]
        if case["note"] in MENDED:
            continue
        if parsed is None:
            with pytest.raises(SchemeError):
                read(case["text"])
            refused += 1
            continue
        scheme = read(case["text"])
        assert scheme.name == parsed["name"]
        assert scheme.decision_maker.name == parsed["decision_maker"]
        assert scheme.decision_maker.bias == parsed["bias"]
        assert list(scheme.breeds) == parsed["breeds"]
        assert {p: list(xy) for p, xy in scheme.plan_positions.items()} == parsed["plan_positions"]
        assert list(scheme.cognitons) == [expected_cogniton(c) for c in parsed["cognitons"]]
        assert list(scheme.groups) == [expected_group(g) for g in parsed["groups"]]
        agreed += 1
    assert (agreed, refused) == (13, 2)


def test_recorded_cases_save_and_load_again(shared_data):
    for case in json.loads(shared_data("cogscheme_vectors.json").read_text()):
        if case["parsed"] is None:
            continue
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            scheme = read(case["text"])
            assert read(written(scheme)) == scheme
            # What CogLogo made of the file on saving reads as the same scheme, too.
            if case["note"] not in MENDED:
                assert read(case.get("resaved_text", case["text"])) == scheme


@pytest.mark.parametrize(
    ("name", "plans", "culturons"),
    [
        ("farmer_artisan", 4, 0),
        ("farmers_artisans_traders", 4, 4),
        ("herd_cows", 5, 2),
        ("wolf_cow_cows", 3, 0),
        ("wolf_cow_wolves", 2, 0),
    ],
)
def test_files_of_the_original_models(shared_data, tmp_path, name, plans, culturons):
    path = shared_data(f"cogscheme/{name}.cogscheme")
    scheme = CognitiveScheme.load(path)
    assert len(scheme.plans) == plans
    assert sum(len(role.culturons) for g in scheme.groups for role in g.roles) == culturons
    for suffix in ("cogscheme", "yaml"):
        scheme.save(tmp_path / f"a.{suffix}")
        assert CognitiveScheme.load(tmp_path / f"a.{suffix}") == scheme


def test_a_file_with_everything_is_written_back_letter_by_letter():
    text = (
        "STARTCS\nhumans\nBiasedWeightedStochastic 2.6\nPLANPOS\ngrow=97:-97\nBREEDS\nmen\nWomen\n"
        "COG\nfarmer\n-13408513\nfalse\n0.25\n441:211\n"
        "INFLUENCE\ngrow=5.0\nDEPENDENCY\ngrow\nREINFORCEMENT\ntrade=-1.0E-5\n"
        "GRP\ntown\nROL\nfounder\n"
        "COG\ndemand\n-8355712\n1.0\n1:2\nINFLUENCE\ngrow=1.0\nDEPENDENCY\nREINFORCEMENT\ngrow=2.0\n"
        "ROL\nmember\nGRP\nempty\nENDCS\n"
    )
    farmer = Cogniton(
        "farmer", False, 0.25, (51, 102, 255), (441, 211), {"grow": 5}, ("grow",), {"trade": -1e-5}
    )
    demand = Culturon(
        "demand", 1, position=(1, 2), influence={"grow": 1}, reinforcement={"grow": 2}
    )
    scheme = read(text)
    assert scheme == CognitiveScheme(
        "humans",
        (farmer,),
        (Group("town", (Role("founder", (demand,)), Role("member"))), Group("empty")),
        BiasedWeightedStochastic(2.6),
        ("men", "Women"),
        {"grow": (97, -97)},
    )
    assert written(scheme) == text.replace("-1.0E-5", "-1e-05")


@pytest.mark.parametrize("end", ["\r\n", "\r"])
def test_any_end_of_line_will_do(end):
    assert read((HEAD + BASE + "ENDCS\n").replace("\n", end)) == with_base()


def test_lines_end_nowhere_else():
    assert read("STARTCS\na\u2028b\x0bc\nMaximumWeight").name == "a\u2028b\x0bc"


@pytest.mark.parametrize("end", ["ENDCS", "", "ENDCS\nanything\nafter it\n"])
def test_the_end(end):
    assert read(HEAD + BASE + end) == with_base()


def test_a_file_in_an_old_encoding_or_with_a_mark_at_its_start(tmp_path):
    text = HEAD + BASE.replace("base", "fière")
    for encoding in ("utf-8", "utf-8-sig", "latin-1"):
        (tmp_path / "a.cogscheme").write_bytes(text.encode(encoding))
        assert CognitiveScheme.load(tmp_path / "a.cogscheme").cognitons[0].name == "fière"


@pytest.mark.parametrize(
    ("lines", "starting", "value", "position"),
    [
        ("true", True, 0.0, None),
        ("TRUE", True, 0.0, None),
        ("False\n1e3", False, 1000.0, None),
        ("true\n.5", True, 0.5, None),
        ("true\n-2", True, -2.0, None),
        ("true\n 2.5d ", True, 2.5, None),
        ("true\n3f\n-4:+5", True, 3.0, (-4, 5)),
    ],
)
def test_what_may_stand_between_colour_and_influence(lines, starting, value, position):
    (cogniton,) = read(f"{HEAD}COG\na\n255\n{lines}\nINFLUENCE\n").cognitons
    assert cogniton == Cogniton("a", starting, value, (0, 0, 255), position)


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ("1.0\n", "8: found '1.0' for true or false; taken as false"),
        ("", "8: nothing says whether cogniton 'a' is there at birth; taken as false"),
    ],
)
def test_a_doubtful_start_is_false_as_in_coglogo_but_said(lines, message):
    with pytest.warns(UserWarning, match=message):
        scheme = read(f"{HEAD}COG\na\n255\n{lines}INFLUENCE\n")
    assert scheme.cognitons[0].starting is False


@pytest.mark.parametrize(
    "rest", ["", "ENDCS\n", "BREEDS\nbulls\n" + BASE, BASE, "PLANPOS\neat=1:2\n"]
)
def test_a_missing_maker_means_maximum_weight_with_a_warning(rest):
    with pytest.warns(UserWarning, match=r"cows\.cogscheme:3: no line for the decision maker"):
        scheme = read(f"STARTCS\ncows\n{rest}")
    assert scheme == read(f"STARTCS\ncows\nMaximumWeight\n{rest}")
    assert scheme.decision_maker == MaximumWeight()


def test_groups_without_cognitons_are_groups():
    text = HEAD + "GRP\nherd\nROL\nleader\nCOG\nlead\n-1\n1.0\nINFLUENCE\ngo=10.0\n"
    scheme = read(text)
    assert scheme.breeds == ()
    lead = Culturon("lead", 1, (255, 255, 255), influence={"go": 10})
    assert scheme.groups == (Group("herd", (Role("leader", (lead,)),)),)
    with pytest.warns(UserWarning, match="groups but no cogniton"):
        assert read(written(scheme)) == scheme


def test_breeds_and_plan_positions_come_in_either_order():
    text = "STARTCS\ncows\nMaximumWeight\nBREEDS\nCows\n\nPLANPOS\neat=1:-2\nENDCS"
    scheme = read(text)
    assert scheme.breeds == ("Cows", "")
    assert scheme.plan_positions == {"eat": (1, -2)}


def test_a_repeated_cogniton_is_one_and_reported():
    again = "COG\nbase\n1\nfalse\n7\n1:1\nINFLUENCE\nflee=1\neat=9\nDEPENDENCY\nflee\n"
    scheme = with_base(again)
    assert scheme.cognitons == (
        replace(BASE_COGNITON, influence={"eat": 9.0, "flee": 1.0}, conditional=("eat", "flee")),
    )
    assert scheme.repeated == ("cogniton 'base' (line 16)",)


def test_repeated_groups_roles_and_culturons_are_one_and_reported():
    culturon = "COG\nk\n1\n{}\nINFLUENCE\n{}=1\n"
    scheme = with_base(
        "GRP\ng\nROL\nr\n" + culturon.format(1, "a") + culturon.format(2, "b")
        + "ROL\nr\n" + culturon.format(3, "c") + "GRP\ng\nROL\ns\n"
    )  # fmt: skip
    k = Culturon("k", 3, (0, 0, 1), influence={"a": 1, "b": 1, "c": 1})
    assert scheme.groups == (Group("g", (Role("r", (k,)), Role("s"))),)
    assert [what.split(" (")[0] for what in scheme.repeated] == [
        "culturon 'k' of role 'r'",
        "role 'r' of group 'g'",
        "culturon 'k' of role 'r'",
        "group 'g'",
    ]


def test_repeated_dependency_lines_are_one_link():
    scheme = with_base("GRP\ng\nROL\nr\nCOG\nk\n1\nINFLUENCE\nDEPENDENCY\ngo\nrest\ngo\n")
    assert scheme.groups[0].roles[0].culturons[0].conditional == ("go", "rest")
    assert written(scheme).count("\ngo\n") == 1


def test_culturons_keep_their_reinforcement():
    scheme = with_base("GRP\ng\nROL\nr\nCOG\nk\n1\nINFLUENCE\nREINFORCEMENT\ngo=0.5\n")
    assert scheme.groups[0].roles[0].culturons[0].reinforcement == {"go": 0.5}
    assert read(written(scheme)) == scheme


def test_blank_lines_and_spaces_are_part_of_names():
    text = HEAD + "COG\n a\n255\ntrue\nINFLUENCE\neat = 1.5\n=2\nDEPENDENCY\n\neat \n"
    (cogniton,) = read(text).cognitons
    assert cogniton.name == " a"
    assert cogniton.influence == {"eat ": 1.5, "": 2.0}
    assert cogniton.conditional == ("", "eat ")


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("", 1, "found the end of the file; expected STARTCS"),
        ("hello\nSTARTCS\n", 1, "found 'hello'; expected STARTCS"),
        ("STARTCS", 2, "found the end of the file; expected the name of the scheme; the file may"),
        ("STARTCS\ncows\nMaximumWeight one\n", 3, "found 'MaximumWeight one'; expected a finite"),
        ("STARTCS\ncows\nMaximumWeight 1 2\n", 3, "expected a decision maker and its bias"),
        ("STARTCS\ncows\n\n", 3, "found ''; expected a decision maker and its bias"),
        ("STARTCS\ncows\nMaximumweight\n", 3, "did you mean 'MaximumWeight'?"),
        ("STARTCS\ncows\nMaximumWeight 0\n", 3, "bias 0.0 of the decision maker MaximumWeight"),
        ("STARTCS\ncows\nBiasedWeightedStochastic -1\n", 3, "expected a finite number above 0"),
        ("STARTCS\ncows\nBiasedWeightedStochastic NaN\n", 3, "expected a finite number"),
        ("STARTCS\ncows\nMaximumWeight\nbulls\n", 4, "found 'bulls'; expected PLANPOS, BREEDS"),
        (HEAD + "COG\n", 6, "found the end of the file; expected the name of a cogniton"),
        (HEAD + "COG\na\nred\n", 7, "found 'red'; expected a whole number of 32 bits"),
        (HEAD + "COG\na\n4294967295\n", 7, "expected a whole number of 32 bits"),
        (HEAD + "COG\na\n1\ntrue\nten\nINFLUENCE\n", 9, "found 'ten'; expected a finite number"),
        (HEAD + "COG\na\n1\ntrue\n1_0\nINFLUENCE\n", 9, "found '1_0'; expected a finite number"),
        (HEAD + "COG\na\n1\ntrue\n1e999\nINFLUENCE\n", 9, "expected a finite number"),
        (HEAD + "COG\na\n1\ntrue\n1\n5\nINFLUENCE\n", 10, "found '5'; expected a position x:y"),
        (HEAD + "COG\na\n1\ntrue\n1\n1:2\n3\nINFLUENCE\n", 11, "found '3'; expected INFLUENCE"),
        (HEAD + "COG\na\n1\ntrue\nDEPENDENCY\n", 9, "found 'DEPENDENCY'; expected INFLUENCE"),
        (HEAD + "COG\na\n1\ntrue\nINFLUENCE\neat\n", 10, "found 'eat'; expected plan=weight"),
        (HEAD + "COG\na\n1\ntrue\nINFLUENCE\neat=\n", 10, "found 'eat='; expected a finite number"),
        (HEAD + "COG\na\n1\ntrue\nINFLUENCE\na=b=1\n", 10, "found 'a=b=1'; expected a finite"),
        (HEAD + BASE + "ROL\nr\n", 16, "found 'ROL'; expected COG, GRP or ENDCS"),
        (HEAD + BASE + "GRP\ng\nCOG\nk\n", 18, "found 'COG'; expected ROL, GRP or ENDCS"),
        (HEAD + BASE + "GRP\ng\nr\n", 18, "found 'r'; expected ROL, GRP or ENDCS"),
        ("STARTCS\ncows\nMaximumWeight\nPLANPOS\neat\n", 5, "found 'eat'; expected plan=x:y"),
        ("STARTCS\ncows\nMaximumWeight\nPLANPOS\neat=1.5:2\n", 5, "expected a whole number"),
    ],
)  # fmt: skip
def test_errors_say_the_line_what_is_there_and_what_should_be(text, line, message):
    with pytest.raises(SchemeError) as failure:
        read(text)
    assert str(failure.value).startswith(f"cows.cogscheme:{line}: ")
    assert message in str(failure.value)
    assert (failure.value.file, failure.value.line) == ("cows.cogscheme", line)


@pytest.mark.parametrize(
    ("scheme", "message"),
    [
        (CognitiveScheme("two\nlines"), "scheme name 'two\\nlines'; expected a name on one line"),
        (CognitiveScheme("s", (Cogniton("a\rb"),)), "cogniton name 'a\\rb'"),
        (CognitiveScheme("s", (Cogniton("COG"),)), "cogniton name 'COG'; expected a name other"),
        (CognitiveScheme("s", (Cogniton("a", influence={"p=q": 1}),)), "found the plan name 'p=q'"),
        (CognitiveScheme("s", (Cogniton("a", reinforcement={"GRP": 1}),)), "plan name 'GRP'"),
        (CognitiveScheme("s", (Cogniton("a", conditional=("ENDCS",)),)), "plan name 'ENDCS'"),
        (CognitiveScheme("s", plan_positions={"=": (1, 2)}), "found the plan name '='"),
        (CognitiveScheme("s", breeds=("BREEDS",)), "found the breed name 'BREEDS'"),
        (CognitiveScheme("s", groups=(Group("ROL"),)), "found the group name 'ROL'"),
        (CognitiveScheme("s", groups=(Group("g", (Role("\n"),)),)), "found the role name '\\n'"),
        (CognitiveScheme("s", plan_order=("p",)), "a CogLogo file holds no other"),
        (
            CognitiveScheme("s", groups=(Group("g", (Role("r", position=(1, 2)),)),)),
            "positions of the group 'g' or of its roles; expected none",
        ),
    ],
)  # fmt: skip
@pytest.mark.filterwarnings("ignore:.*has groups but no cogniton")
def test_what_a_file_of_lines_cannot_hold_is_refused(tmp_path, scheme, message):
    with pytest.raises(SchemeError) as failure:
        scheme.save(tmp_path / "a.cogscheme")
    assert message in str(failure.value)
    assert ".yaml" in str(failure.value)
    assert not (tmp_path / "a.cogscheme").exists()
    scheme.save(tmp_path / "a.yaml")
    assert CognitiveScheme.load(tmp_path / "a.yaml") == scheme
