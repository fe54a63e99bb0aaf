"""What is done to a society by hand: interventions at the tick where it stands."""

from __future__ import annotations

from typing import Any

from coglogo_py import CogLogoError
from socialmind.errors import SocialmindError, nearest
from socialmind.interventions.change import Change
from socialmind.interventions.edit import Edit
from socialmind.interventions.shock import Shock
from socialmind.interventions.steer import Steer
from socialmind.learning.imprinting.steered import recording_of
from socialmind.society.settings import sorted_out
from socialmind.studio.running.stage import Stage
from socialmind.studio.schemes.checking import Bearers, continued, runnable_of, same_minds


def press(stage: Stage, button: str) -> None:
    """Do what a button of the model's own does."""
    buttons = type(stage.run.society).buttons
    if button not in buttons:
        raise SocialmindError(f"no button {button!r}; {nearest(button, buttons)}")
    stage.intervene(Shock(stage.run.tick, buttons[button]))


def set_parts(stage: Stage, **settings: Any) -> None:
    """Change parameters, or parts of schemes by their words, from the next tick on."""
    run = stage.run
    kind, schemes = type(run.society), run.society.schemes
    sorted_settings = sorted_out(kind, settings)
    words = sorted_settings.changed(schemes, run.society.populations)
    stage.intervene(Change(run.tick, sorted_settings.parameters, words))


def edit(stage: Stage, population: str, id: int, part: str, value: Any) -> None:
    """Change a value of an agent by hand."""
    stage.intervene(Edit(stage.run.tick, population, id, part, value))


def steer(stage: Stage, population: str, id: int, commands: list[float] | None) -> None:
    """Tell a robot what to do, until something else is told; None, give it back to its mind."""
    told = None if commands is None else tuple(commands)
    stage.intervene(Steer(stage.run.tick, population, id, told))


def imprint(stage: Stage, population: str, skill: str, folder: str) -> None:
    """Write what a skill was shown by steering as a table for imprinting."""
    run = stage.run
    stage.say("busy", text="writing")
    society, interventions = run.repeated()
    shown, about = recording_of(society, interventions, run.tick, skill, population)
    shown.write(folder, about)
    stage.say("saved", folder=folder, records=len(shown))


def rescheme(stage: Stage, population: str, document: Any, token: int = 0) -> None:
    """Give the minds of a population an edited scheme; who has the same one gets it too.

    The society goes on if it does not fit: that is said with the `token` of the page.
    """
    run = stage.run
    schemes = run.society.schemes
    try:
        edited = runnable_of(document, Bearers.of(type(run.society), population))
        scheme = continued(edited, schemes[population])
        named = {name: scheme for name, one in schemes.items() if one == schemes[population]}
        if same_minds(scheme, schemes[population]):
            stage.say_changed(token)
        else:
            stage.intervene(Change(run.tick, {}, named), token)
    except (SocialmindError, CogLogoError) as error:
        stage.say("unfit", token=token, text=str(error))
