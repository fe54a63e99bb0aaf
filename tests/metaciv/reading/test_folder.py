"""Whole folders: formats, what is mended, what is missing, what is wrong."""

import os
import random

import pytest

from socialmind.errors import SocialmindError
from socialmind.metaciv.reading import read_folder

from .folders import FARMERS, SAMPLES, flat, written

PLAN = "schemasCognitifs/Farmer/plans/Work.metaciv"
MAP = "simulation/environnements/Valley.metaciv"


def reading_of(folder, changes=None, files=FARMERS):
    """Read a folder in which files are others, or, with None, missing."""
    files = {**files, **(changes or {})}
    return read_folder(written(folder, {k: v for k, v in files.items() if v is not None}))


def said(reading):
    return [(one.severity, *one.place, str(one).partition(": ")[2]) for one in reading.findings]


def test_all_of_a_folder(tmp_path):
    reading = reading_of(tmp_path)
    assert reading.findings == ()
    model = reading.model
    assert (model.older, model.parameters.decision_maker) == (False, "MaxWeight")
    assert model.environment.rows == ((0, 0, 1), (0, 0, 0))
    place = model.environment.settlements[0]
    assert (place.civilisation, place.u, place.v, place.place.line) == ("Farmers", 0, 1, 4)
    (scheme,) = model.schemes
    hungry, will = scheme.cognitons
    assert (will.description, will.initial, will.type) == ("wants : more", True, "belief")
    assert [(one.comparison, one.constant) for one in hungry.triggers] == [
        ("<", "meal"), ("==", None),
    ]  # fmt: skip
    (group,) = scheme.groups
    assert ([role.name for role in group.roles], group.auto_join) == (["chief", "member"], "member")
    bread, _ = model.objects
    assert (bread.recipe[0].object, bread.recipe[0].count) == ("Sack of corn", 2)
    assert model.facilities[0].recipe[0].object == "Brown bread"
    assert (model.effects[0].value, model.effects[0].activation) == (1.5, "use")


def test_plans_are_trees_of_actions_with_arguments_in_order(tmp_path):
    (plan,) = reading_of(tmp_path).model.schemes[0].plans
    compare, change, move = plan.actions
    assert [one.value for one in compare.arguments] == ["Brown bread", ">=", 1.0]
    use, instant = compare.children
    assert use.argument("Integer").value == 1
    create, lower = instant.children
    assert create.name == "A_CreateObject"
    energy, amount = lower.arguments
    assert (energy.value, amount.value, amount.constant) == ("energy", -1, "meal")
    assert (change.arguments[0].value, change.arguments[0].role) == ("Village", "chief")
    assert (move.direction, move.place.line) == ("NORTH", 11)


def test_the_older_format_lies_flat(tmp_path):
    reading = reading_of(tmp_path, {PLAN: None}, flat())
    assert [one.severity for one in reading.findings] == ["warning"], said(reading)
    assert "constant" in str(reading.findings[0])
    model = reading.model
    assert model.older and model.parameters.vision_radius == 10
    assert model.civilisations[0].scheme == model.schemes[0].name == tmp_path.name
    assert model.civilisations[0].cognitons == ("Hungry",)
    assert model.schemes[0].cognitons[0].start_chance == 40


@pytest.mark.skipif(SAMPLES is None, reason="the samples are not here")
@pytest.mark.parametrize("name", ["berries", "control", "hunger", "one_plan", "team"])
def test_samples_are_read_without_errors(name):
    reading = read_folder(SAMPLES / name)
    assert reading.model is not None
    assert [str(one) for one in reading.findings if "grows without bound" not in str(one)] == []


BROKEN = FARMERS | {
    PLAN: "Nom : Work\nAction : A_Move,EAST\nAction : A_Mover,EAST\n"
    "Action : A_AddCogniton,Cogniton(Cogniton Hungri)\n",
    MAP: "Nom : Valley\nLargeur : 3\nHauteur : 2\nCivilisation : Farmers,0,1\n\n"
    "Terrain : Grass\nTerrain : Bog\nTerrain : Marécage\nTerrain : Mud\n"
    "Rang : 0,1,0\nRang : 0,2\n",
    "simulation/terrains/Grass.metaciv": "Nom : Grass\nCouleur : 0.3,0.8,0.8\nPassabilite : 2O\n",
    "simulation/terrains/Marecage.metaciv": "Nom : Marécage\nPassabilite : 45\n".encode("latin-1"),
}


def test_all_that_is_wrong_is_said_at_once(tmp_path):
    assert said(reading_of(tmp_path, files=BROKEN)) == [
        (
            "error", PLAN, 3,
            "found 'A_Mover'; expected the name of an action; did you mean 'A_Move'?",
        ),
        (
            "error", PLAN, 4,
            "found 'Hungri'; expected the name of a cogniton; did you mean 'Hungry'?",
        ),
        (
            "error", MAP, 7,
            "found 'Bog'; expected the name of a terrain; there is 'Grass', 'Marécage', 'Rock'; "
            "row 1 uses it (index 1)",
        ),
        (
            "warning", MAP, 9,
            "found 'Mud'; expected the name of a terrain; there is 'Grass', 'Marécage', 'Rock'; "
            "no row uses it",
        ),
        ("error", MAP, 11, "found 2 entries in row 2; expected 3, the map's Largeur"),
        (
            "error", "simulation/terrains/Grass.metaciv", 3,
            "found '2O'; expected a whole number of 0 or more",
        ),
        (
            "warning", "simulation/terrains/Marecage.metaciv", 1,
            "found the byte 0xe9; expected UTF-8; the file was read as Latin-1",
        ),
    ]  # fmt: skip


@pytest.mark.skipif(SAMPLES is None, reason="the samples are not here")
def test_the_sample_with_six_faults():
    reading = read_folder(SAMPLES / "broken")
    assert reading.model is None
    assert [(one.severity, *one.place) for one in reading.findings] == [
        ("error", "schemasCognitifs/Lost/plans/Wander.metaciv", 6),
        ("error", "schemasCognitifs/Lost/plans/Wander.metaciv", 7),
        ("error", "simulation/environnements/Marsh.metaciv", 7),
        ("error", "simulation/environnements/Marsh.metaciv", 10),
        ("error", "simulation/terrains/Grass.metaciv", 3),
        ("warning", "simulation/terrains/Marecage.metaciv", 1),
    ]


def test_folders_that_git_drops_are_empty_ones(tmp_path):
    gone = [one for one in FARMERS if "/effects/" in one or "/amenagements/" in one]
    gone += [one for one in FARMERS if "/groups/" in one or "/plans/" in one or "/objets/" in one]
    changes = dict.fromkeys(gone) | {
        "schemasCognitifs/Farmer/cognitons/Will.metaciv": "Nom : Will\nInitial : 1\n",
        "schemasCognitifs/Farmer/cognitons/Hungry.metaciv": None,
    }
    reading = reading_of(tmp_path, changes)
    assert (reading.findings, reading.model.schemes[0].plans) == ((), ())


@pytest.mark.parametrize("ending", ["\r\n", "\r"])
def test_line_ends_of_other_systems(tmp_path, ending):
    files = {file: text.replace("\n", ending).encode() for file, text in FARMERS.items()}
    here, there = tmp_path / "a" / "m", tmp_path / "b" / "m"
    assert reading_of(here, files=files) == reading_of(there)


def test_names_in_other_letter_case_are_found(tmp_path):
    files = {
        file.replace("simulation", "Simulation").replace("plans/Work", "Plans/Work"): text
        for file, text in FARMERS.items()
    }
    files["Parametres.METACIV"] = files.pop("parametres.metaciv")
    reading = reading_of(tmp_path / "a" / "m", files=files)
    sound = reading_of(tmp_path / "b" / "m").model
    assert reading.findings == ()
    assert reading.model.schemes[0].plans[0].name == sound.schemes[0].plans[0].name
    assert reading.model.terrains[0].place.file == "Simulation/terrains/Grass.metaciv"
    assert reading.model.environment.rows == sound.environment.rows


def test_blanks_at_the_ends_of_lines_are_no_part_of_names(tmp_path):
    files = {
        file: "".join(f"{line}  \n" for line in text.splitlines()) for file, text in FARMERS.items()
    }
    here, there = tmp_path / "a" / "m", tmp_path / "b" / "m"
    assert reading_of(here, files=files) == reading_of(there)


def test_a_byte_order_mark_is_no_part_of_a_key(tmp_path):
    text = FARMERS["simulation/itemPheromones/Corn.metaciv"]
    reading = reading_of(tmp_path, {"simulation/itemPheromones/Corn.metaciv": "\ufeff" + text})
    assert reading.findings == ()


def test_the_order_is_that_of_names_whatever_the_system_says(tmp_path):
    files = list(FARMERS.items())
    random.Random(3).shuffle(files)
    assert reading_of(tmp_path / "a" / "m", files=dict(files)) == reading_of(tmp_path / "b" / "m")


def test_two_terrains_of_one_colour_are_two(tmp_path):
    grey = FARMERS["simulation/terrains/Rock.metaciv"].replace("0.0,0.0,0.4", "0.3,0.8,0.8")
    reading = reading_of(tmp_path, {"simulation/terrains/Rock.metaciv": grey})
    assert reading.findings == ()
    assert [one.impassable for one in reading.model.terrains] == [False, True]


@pytest.mark.parametrize("carte", ["My.valley.metaciv", "My.valley", "Valley.metaciv", "Valley"])
def test_maps_may_have_dots_in_their_names(tmp_path, carte):
    settings = FARMERS["parametres.metaciv"].replace("Valley.metaciv", carte)
    reading = reading_of(
        tmp_path,
        {
            "parametres.metaciv": settings,
            "simulation/environnements/My.valley.metaciv": FARMERS[MAP].replace(
                "Nom : Valley", "Nom : My.valley"
            ),
            "simulation/environnements/Old.metaciv": "Nom : Old\nLargeur : x\n",
        },
    )
    assert reading.findings == ()
    assert carte.startswith(reading.model.environment.name)


def test_of_two_things_of_one_name_the_first_counts(tmp_path):
    second = "simulation/objets/Zopf.metaciv"
    reading = reading_of(tmp_path, {second: "Nom : Brown bread\nObjets : Nothing,\n"})
    assert said(reading) == [
        (
            "warning", second, 1,
            "a second object called 'Brown bread'; simulation/objets/Bread.metaciv counts",
        )
    ]  # fmt: skip
    assert len(reading.model.objects) == 2


def test_of_two_plans_of_every_tick_the_last_counts(tmp_path):
    home = "schemasCognitifs/Farmer/plans"
    plans = {
        f"{home}/{name}.metaciv": f"Nom : {name}\nSelf : true\nBirth : true\nAction : A_DoNothing\n"
        for name in ("Age", "Tire")
    }
    reading = reading_of(tmp_path, plans)
    assert {one.name: one.kind for one in reading.model.schemes[0].plans} == {
        "Age": "plan", "Tire": "self", "Work": "plan",
    }  # fmt: skip
    assert [one.place for one in reading.findings] == [(f"{home}/Age.metaciv", 1)]


def test_a_birth_at_birth_would_never_end(tmp_path):
    file = "schemasCognitifs/Farmer/plans/Born.metaciv"
    plan = "Nom : Born\nBirth : true\nAction : A_BirthGroupAndRole,r(GroupAndRole Village:chief)\n"
    assert said(reading_of(tmp_path, {file: plan})) == [
        (
            "error", file, 3,
            "found A_BirthGroupAndRole in the plan of birth; expected no birth at birth; "
            "each child would have a child at once",
        )
    ]  # fmt: skip


def test_what_is_wrong_in_a_scheme_that_nobody_has_does_not_matter(tmp_path):
    home = "schemasCognitifs/Old"
    files = {
        f"{home}/plans/Rest.metaciv": "Nom : Rest\nAction : A_Sleep\n",
        f"{home}/cognitons/Tired.metaciv": "Nom : Tired\nPermet : Rest\n",
    }
    reading = reading_of(tmp_path, files)
    assert [one.severity for one in reading.findings] == ["warning", "warning"]
    assert str(reading.findings[1]).endswith("no civilisation has this scheme")
    assert [one.name for one in reading.model.schemes] == ["Farmer"]


def test_what_is_wrong_in_a_plan_that_nothing_permits_does_not_matter(tmp_path):
    file = "schemasCognitifs/Farmer/plans/Kill.metaciv"
    will = "schemasCognitifs/Farmer/cognitons/Will.metaciv"
    files = {
        file: "Nom : Kill\nAction : A_DropObject\n",
        will: FARMERS[will] + "Influence : Kill,3\n",
    }
    reading = reading_of(tmp_path, files)
    assert [str(one) for one in reading.findings] == [
        f"{file}:2: found A_DropObject without its Objet; "
        "expected an argument `label(Objet …)`; nothing permits this plan",
        f"{file}:2: found A_DropObject without its Integer; "
        "expected an argument `label(Integer …)`; nothing permits this plan",
    ]
    (scheme,) = reading.model.schemes
    assert [one.name for one in scheme.plans] == ["Work"]
    assert {link.plan for one in scheme.cognitons for link in one.influences} == {"Work"}


def test_actions_of_the_models_own_are_no_errors(tmp_path):
    plan = FARMERS[PLAN] + "Action : A_Pray,to(Nobody knows)\n\tAction : A_DoNothing\n"
    reading = reading_of(tmp_path, {PLAN: plan, "simulation/actions/x/A_Pray.class": b"\xca\xfe"})
    assert [(one.severity, one.place.line) for one in reading.findings] == [("unsupported", 12)]
    assert reading.model.schemes[0].plans[0].actions[-1].name == "A_Pray"


def test_what_lacks_a_name_has_its_files(tmp_path):
    home = "schemasCognitifs/Farmer/plans"
    text = FARMERS[PLAN].replace("Nom : Work\n", "")
    will = FARMERS["schemasCognitifs/Farmer/cognitons/Will.metaciv"].replace("Work", "What next?")
    hungry = "schemasCognitifs/Farmer/cognitons/Hungry.metaciv"
    reading = reading_of(
        tmp_path,
        {
            PLAN: None,
            f"{home}/What+next%3F.metaciv": text,
            "schemasCognitifs/Farmer/cognitons/Will.metaciv": will,
            hungry: FARMERS[hungry].replace("Work", "What next?"),
        },
    )
    assert [one.severity for one in reading.findings] == ["warning"], said(reading)
    assert reading.model.schemes[0].plans[0].name == "What next?"


def test_who_begins_where_nobody_can_stand_is_an_error(tmp_path):
    everywhere = FARMERS[MAP].replace("0,0,1\nRang : 0,0,0", "1,1,0\nRang : 1,1,0")
    reading = reading_of(tmp_path, {MAP: everywhere})
    assert said(reading) == [
        (
            "error", MAP, 4,
            "'Farmers' begins on 'Rock', which nobody can enter; "
            "move the place, or scatter its agents",
        )
    ]  # fmt: skip


def test_civilisations_without_files_begin_nowhere(tmp_path):
    two = FARMERS[MAP].replace("Civilisation :", "Civilisation : Nomads,1,1\nCivilisation :")
    reading = reading_of(tmp_path, {MAP: two})
    assert [(one.severity, one.place.line) for one in reading.findings] == [("warning", 4)]
    assert [one.civilisation for one in reading.model.environment.settlements] == ["Farmers"]


def test_an_effect_on_what_is_nowhere_is_left_out_and_said_once(tmp_path):
    file = "simulation/effects/Fed.metaciv"
    reading = reading_of(tmp_path, {file: FARMERS[file].replace("energy", "strength")})
    assert said(reading) == [
        (
            "warning", file, 3,
            "found 'strength'; expected the name of an attribute; there is 'energy'; "
            "the effect was left out",
        )
    ]  # fmt: skip
    assert (reading.model.effects, reading.model.objects[0].effects) == ((), ())


def test_links_that_lead_out_are_not_followed(tmp_path):
    folder = written(tmp_path / "model", FARMERS)
    secret = tmp_path / "secret.metaciv"
    secret.write_text("Nom : Secret\n")
    (folder / "simulation/objets/Secret.metaciv").symlink_to(secret)
    elsewhere = written(tmp_path / "elsewhere", {"Gold.metaciv": "Nom : Gold\n"})
    (folder / "schemasCognitifs/Farmer/cloudCognitons").symlink_to(elsewhere)
    reading = read_folder(folder)
    assert [str(one) for one in reading.findings] == [
        "simulation/objets/Secret.metaciv:1: a link that leads out of the model's folder"
    ]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes here")
def test_what_is_no_file_is_left_out(tmp_path):
    folder = written(tmp_path, FARMERS)
    os.mkfifo(folder / "simulation/objets/Pipe.metaciv")
    (folder / "simulation/objets/Folder.metaciv").mkdir()
    assert [one.severity for one in read_folder(folder).findings] == ["warning"] * 2


def test_no_folder_and_no_model_are_one_sentence(tmp_path):
    with pytest.raises(SocialmindError, match="no such folder"):
        read_folder(tmp_path / "none")
    with pytest.raises(SocialmindError, match=r"found no parametres\.metaciv"):
        read_folder(tmp_path)
