"""Curricula: the order of lessons, cycles with and without end."""

import pytest

from socialmind.errors import ModelError, SocialmindError
from socialmind.learning import Curriculum, Cycle, Lesson
from socialmind.learning.lessons.curriculum import Position


class Field:
    pass


A, B, C = (Lesson(name, Field) for name in "ABC")


def names(curriculum, at_most=20, over_at=()):
    position, found = Position(), []
    while position is not None and len(found) < at_most:
        found.append(curriculum.at(position).name)
        position = curriculum.next(position, cycle_over=len(found) in over_at)
    return "".join(found)


def test_lessons_come_in_order_and_cycles_go_round():
    assert names(Curriculum([A, B, C])) == "ABC"
    assert names(Curriculum([A, Cycle([B, C], cycles=3)])) == "ABCBCBC"
    assert names(Curriculum([Cycle([A, B], cycles=2), C])) == "ABABC"
    assert names(Curriculum([A, Cycle([B, C])]), at_most=9) == "ABCBCBCBC"


def test_a_cycle_can_be_ended_in_its_middle():
    assert names(Curriculum([Cycle([A, B], cycles=9), C]), over_at=[3]) == "ABAC"
    assert names(Curriculum([Cycle([A, B])]), over_at=[3]) == "ABA"


def test_positions_of_a_cycle_without_end_are_those_of_one_time_around():
    endless = Curriculum([A, Cycle([B, C])])
    assert [endless.at(one).name for one in endless.positions()] == ["A", "B", "C"]


def test_cycles_are_told_how_often():
    endless = Curriculum([A, Cycle([B])])
    assert names(endless.with_cycles(2)) == "ABB"
    assert endless.with_cycles(budget=9).items[1].budget == 9


def test_some_lessons_are_chosen_in_their_order():
    chosen = Curriculum([A, Cycle([B, C])], mind="mind").only(["C", "A"])
    assert names(chosen) == "AC"
    assert chosen.mind == "mind"
    with pytest.raises(SocialmindError, match="no lesson called 'D'; there is A, B"):
        Curriculum([A, B]).only(["D"])


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: Curriculum([]), "a curriculum without lessons"),
        (lambda: Curriculum([A, Cycle([Lesson("A", Field)])]), "two lessons called 'A'"),
        (lambda: Curriculum([Cycle([A]), B]), "without end as item 1 of 2; expected one at the"),
        (lambda: Curriculum([3]), "3 in a curriculum"),
        (lambda: Cycle([]), "a cycle without lessons"),
        (lambda: Cycle([A], cycles=0), "cycles=0 of a cycle"),
        (lambda: Cycle([A], budget=0.5), "budget=0.5 of a cycle"),
    ],
)
def test_wrong_curricula_are_refused(make, said):
    with pytest.raises(ModelError) as raised:
        make()
    assert said in str(raised.value)
