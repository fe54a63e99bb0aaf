"""What rules cannot say is refused with file, line and what to write instead."""

import pytest

from socialmind import ModelError, each, once
from socialmind.language.refusals import MATH_REMEDIES, METHODS, MODULES, NAMES, OPERATORS, REFUSED

HEAD = """\
import math
import random
import sys
import time
from random import random as chance

import numpy as np

from socialmind import Agent

PRICES = {"wheat": 3.0}
TABLE = [1, 2, 3]
NOTHING = None
PAIRS = ((0, 1), (1, 0))
NAMES = ("grow", "rest")
RAGGED = ((1, 2), (3,))
BIG = tuple(range(1001))
NAME = "Hunger"


class Wolf(Agent):
    pass


def helper(x, y=1):
    return x + y


def nothing(x):
    x = x


"""

STATEMENTS = {
    # what is written: a part of what is found, a part of the advice
    "name = 'anna'": ("the text 'anna' as the variable", "where it is used"),
    "person.f = 'anna'": ("the text 'anna' for the field 'f'", "a number"),
    "person.f = 'a' + 'b'": ("the text 'a' where a number is needed", "a field"),
    "person.f = float('inf')": ("the text 'inf'", "math.inf"),
    "person.f = len('anna')": ("the length of the text", "array fields"),
    "person.f = f'{person.i}'": ("an f-string", "after `advance()`"),
    "person.f = str(person.i)": ("str()", "no texts"),
    "x = {'a': 1}": ("a dictionary", "array field"),
    "x = {1, 2}": ("a set", "array field"),
    "x = [1, 2]": ("a list", "array field"),
    "x = []": ("a list", "array field"),
    "x = (1, 2)": ("2 values as the variable", "x, y ="),
    "x = [k for k in range(3)]": ("a list comprehension", "for loop"),
    "x = {k for k in range(3)}": ("a set comprehension", "for loop"),
    "x = {k: k for k in range(3)}": ("a dictionary comprehension", "for loop"),
    "x = (k for k in range(3))": ("a generator expression on its own", "sum("),
    "person.i = sum((k for k in range(3)), 4)": ("sum() of a generator", "for one in"),
    "person.i = max((k for k in range(3)), key=abs)": (
        "one of (k for k in",
        "of agents or patches",
    ),
    "person.i = max((h for h in model.houses), key=3).id": ("the key 3", "key=lambda one"),
    "x = max(model.houses, key=lambda h: h.rooms, default=3)": ("default=3", "default=None"),
    "x = max(model.houses, key=lambda h: h.rms)": ("unknown field 'rms'", "rooms"),
    "x = rng.choice(h.rooms for h in model.houses)": ("one of (h.rooms", "of agents or patches"),
    "x = rng.choice((h for h in model.houses), p=PRICES)": (
        "rng.choice() with p=",
        "without names",
    ),
    "person.b = any((k for k in range(3)), default=1)": ("any() of a generator", "if condition"),
    "person.i = sum(person for other in model.persons)": ("an agent of", "a number"),
    "person.i = sum(k for k in person.f)": ("a for loop over a number", "loop over"),
    "person.i = sum(k async for k in range(3))": ("async for", "plain for"),
    "person.b = any(person.f)": ("a for loop over a number", "loop over"),
    "person.i = PRICES['wheat']": ("'PRICES', which is of the type dict", "a tuple"),
    "person.i = TABLE[0]": ("'TABLE', which is of the type list", "a tuple"),
    "person.f = NOTHING": ("'NOTHING', which is None", "a number"),
    "try:\n        person.f = 1\n    except ValueError:\n        pass": ("try", "if price > 0"),
    "raise ValueError('no')": ("raise", "count the case"),
    "assert person.f > 0": ("assert", "an if"),
    "import math": ("import inside a rule", "top of the file"),
    "from math import sin": ("import inside a rule", "top of the file"),
    "x = lambda y: y": ("lambda", "a function at the top"),
    "def inner():\n        pass": ("a function inside a rule", "top of the file"),
    "class Inner:\n        pass": ("a class inside a rule", "top of the file"),
    "global TABLE": ("global", "model.name"),
    "with open('x') as file:\n        pass": ("with", "no files"),
    "match person.i:\n        case 1:\n            pass": ("match", "if … elif"),
    "if (n := person.i) > 3:\n        pass": (":=", "a line of its own"),
    "person.f = sum(person.vf[1:3])": ("a slice", "for loop"),
    "if person.i in range(3):\n        pass": ("`in`", "x in (1, 2)"),
    "if rng.integers(3) in (1, 2):\n        pass": ("a call", "give it a name"),
    "if person in model.persons:\n        pass": ("`in`", "for loop"),
    "person.i = person.i & 1": ("the operator &", "`and`"),
    "person.i = person.i | 1": ("the operator |", "`and`"),
    "person.i = person.i ^ 2": ("the operator ^", "**"),
    "person.i = person.i << 1": ("the operator <<", "**"),
    "person.i = person.i >> 1": ("the operator >>", "**"),
    "person.f = person.f @ person.g": ("the operator @", "**"),
    "person.i = ~person.i": ("~", "not"),
    "del person.f": ("del", "die()"),
    "yield person.f": ("yield", "return"),
    "print(person.f)": ("print()", "--interpreted"),
    "breakpoint()": ("breakpoint()", "--interpreted"),
    "input()": ("input()", "parameter"),
    "open('x')": ("open()", "no files"),
    "x = sorted(person.vf)": ("sorted()", "for loop"),
    "for k, v in enumerate(person.vf):\n        pass": ("several variables", "range(len("),
    "for k in enumerate(person.vf):\n        pass": ("enumerate()", "range(len("),
    "for k in reversed(range(3)):\n        pass": ("reversed()", "range(n - 1"),
    "for k in zip(person.vf, person.vi):\n        pass": ("zip()", "range(len("),
    "for k in (person.i, 2):\n        pass": ("a for loop over 2 values", "range("),
    "for k in 5:\n        pass": ("a for loop over a whole number", "range("),
    "x = list(range(3))": ("list()", "array field"),
    "x = range(3)": ("range() as a value", "for i in range"),
    "for k in range(person.f):\n        pass": ("a fraction for range()", "int("),
    "for k in range(3, step=2):\n        pass": ("range() like this", "range(start, stop, step)"),
    "person.i = divmod(7, 2)": ("divmod()", "a // b"),
    "person.i = pow(2, 3)": ("pow()", "a ** b"),
    "person.b = isinstance(person.i, int)": ("isinstance()", "one type"),
    "person.b = hasattr(person, 'f')": ("hasattr()", "same fields"),
    "person.f = getattr(person, 'f')": ("getattr()", "agent.field"),
    "person.f = random.random()": ("random.random() in a rule", "rng.random()"),
    "person.f = random.choice(TABLE)": ("random.choice() in a rule", "rng.random()"),
    "person.f = chance()": ("chance() in a rule", "rng.random()"),
    "person.f = np.sqrt(2)": ("numpy.sqrt() in a rule", "`math`"),
    "person.f = np.random.rand()": ("numpy.random", "`math`"),
    "person.f = np.pi": ("numpy.pi", "`math`"),
    "person.f = time.time()": ("time.time() in a rule", "model.tick"),
    "sys.exit()": ("sys.exit() in a rule", "parameter"),
    "person.f = math": ("the module 'math'", "only `math`"),
    "person.f = math.factorial(3)": ("math.factorial()", "for loop"),
    "person.f = math.log(2, 10)": ("math.log() to a base", "math.log(base)"),
    "person.f = math.sine(1)": ("math.sine()", "did you mean 'sin'?"),
    "person.f = math.sin": ("'math.sin' as a value", "call it"),
    "person.f = math.sin(1, 2)": ("2 arguments for math.sin()", "docs/rules.md"),
    "person.f = math.pie": ("the unknown name 'math.pie'", "did you mean 'pi'?"),
    "person.f = round(person.f, 2)": ("round() to decimals", "full precision"),
    "person.f = int('3')": ("the text '3'", "a number"),
    "person.f = abs()": ("abs() of 0 values", "abs(x)"),
    "person.f = max()": ("no values", "two or more"),
    "person.f = max(person.f)": ("largest of a number", "two or more"),
    "person.f = max(1, 2, key=abs)": ("max() with key=", "key=lambda"),
    "person.f = sum(person.f)": ("the sum of a number", "for loop"),
    "person.f = abs": ("the function 'abs' as a value", "call it"),
    "person.f = helper": ("the function 'helper' as a value", "call it"),
    "person.f = helper(1, 2, 3)": ("3 arguments for helper()", "x, y"),
    "person.f = helper()": ("helper() without x", "a value"),
    "person.f = helper(1, z=2)": ("the argument 'z' of helper()", "y"),
    "person.f = helper(1, x=2)": ("the argument 'x' of helper()", "y"),
    "person.f = helper(*TABLE)": ("*", "write the values out"),
    "person.f = helper(**PRICES)": ("** in a call", "write the arguments out"),
    "person.f = helpr(1)": ("the unknown function 'helpr'", "did you mean 'helper'?"),
    "person.f = helper(person.die())": ("None for 'x' of helper()", "one value"),
    "person.f = nothing(1)": ("None for the field 'f'", "a number"),
    "x = nothing(1)": ("'x' from a call that returns nothing", "on its own line"),
    "x = Wolf()": ("Wolf(), which makes an object", "create()"),
    "person.f = helper(1)(2)": ("a call of something without a name", "by its name"),
    "person.f = wheat": ("the unknown name 'wheat'", "there is"),
    "person.wheat = 3": ("the unknown field 'wheat'", "`wheat: float = 0.0`"),
    "person.ff = 3": ("the unknown field 'ff'", "did you mean 'f'?"),
    "person.f = model.pric": ("the model's 'pric'", "did you mean 'price'?"),
    "model.price = 3": ("a new value for the parameter 'price'", "declare a variable"),
    "model.price += 3": ("a new value for the parameter 'price'", "declare a variable"),
    "model.tick = 3": ("a new value for 'tick'", "cannot be set"),
    "person.id = 3": ("a new value for 'id'", "cannot be set"),
    "person.mind = 3": ("a new value for 'mind'", "cannot be set"),
    "model.persons = 3": ("a new value for 'persons'", "cannot be set"),
    "person.vf = 3": ("the whole array 'vf'", "one by one"),
    "person.vf = person.vf": ("the whole array 'vf'", "one by one"),
    "x = person.vf": ("an array of 4 as the variable", "use a field"),
    "person.vf.append(3)": (".append() in a rule", "fixed size"),
    "person.f[0] = 3": ("[…] on a number", "array fields"),
    "person.vf['a'] = 3": ("the text 'a' for the place", "a whole number"),
    "person.vf[0.5] = 3": ("a fraction for the place", "int("),
    "person.f = None": ("None for the field 'f'", "| None"),
    "x = None": ("None as a value", "| None"),
    "if person.f is None:\n        pass": ("never None", "| None"),
    "if person.oi == None:\n        pass": ("None compared by its value", "`is None`"),
    "if None is person.oi:\n        pass": ("None on the left", "`x is None`"),
    "if person.oi:\n        pass": ("may be None as a condition", "`is not None`"),
    "if person.plan:\n        pass": ("may be None as a condition", "`is not None`"),
    "if person:\n        pass": ("an agent of 'persons' as a condition", "a comparison"),
    "if person.f is 3:\n        pass": ("`is` between values", "`==`"),
    "person.b = 1 < person.i is None": ("a chain with `is`", "`and`"),
    "person.i = person.f": ("a fraction for the field 'i'", "int("),
    "person.i = 0.5": ("a fraction for the field 'i'", "round("),
    "person.i = 7 / 2": ("a fraction for the field 'i'", "int("),
    "person.i += 0.5": ("a fraction for the field 'i'", "declare it as float"),
    "person.b = 1": ("a whole number for the field 'b'", "a comparison"),
    "person.f = person.f or person.g": ("whose value is used", "if condition else"),
    "person.f = person + 1": ("an agent of 'persons' where a number", "a field"),
    "person.f = 1 if person.b else True": ("a whole number or a truth value", "the same type"),
    "person.plan = 'grow' if person.b else 'rest'": ("depends on a condition", "two lines"),
    "x: int = 0.5": ("a fraction for a variable declared as a whole number", "int("),
    "x: float": ("a declaration without a value", "a value"),
    "x = True\n    x = 3": ("a whole number for 'x', which is a truth value", "another name"),
    "person.f, person.g = 1, 2": ("fields on the left", "one by one"),
    "x, y = 1, 2, 3": ("3 values for 2 variables", "one value"),
    "x, *y = 1, 2, 3": ("3 values for 2", "one value"),
    "x, y = 3": ("a whole number for 2 variables", "one value"),
    "_x = 3": ("the variable '_x'", "underscore"),
    "person.f = x\n    x = 3": ("not every way", "before the if or the loop"),
    "if person.b:\n        x = 1\n    person.f = x": ("not every way", "before the if"),
    "for k in range(3):\n        x = k\n    person.f = x": ("not every way", "the loop"),
    "for k in range(3):\n        pass\n    person.f = k": ("not every way", "the loop"),
    "for k in range(3):\n        k = 5": ("which counts in a for loop", "another name"),
    "for k in range(3):\n        for k in range(2):\n            pass": (
        "inside its own",
        "another",
    ),
    "for person in model.persons:\n        pass": ("inside its own", "another name"),
    "person.f": ("a value that is not used", "assign it"),
    "person.i + 1": ("a value that is not used", "assign it"),
    "person.f == 3": ("a value that is not used", "assign it"),
    "person.b = person < model.persons[0]": ("a comparison of size", "compare their fields"),
    "person.b = person == model.houses[0]": ("compared with an agent of 'houses'", "their fields"),
    "person.b = person == 3": ("compared with a whole number", "their fields"),
    "person.b = 'a' == 'b'": ("the text 'a' compared", "`RED = 0`"),
    "person.b = person.plan < 'grow'": ("plans in a comparison of size", "=="),
    "person.b = person.plan == 3": ("a plan compared with a whole number", "a plan's name"),
    "person.plan = 3": ("a whole number for the field 'plan'", "a plan's name"),
    "person.live()": ("live() of an agent", "as a function"),
    "person.f()": ("a call of the field 'f'", "without ()"),
    "model.step()": ("step() of the model", "step(model)"),
    "model.persons.append(3)": ("append() of the population", "create"),
    "model.persons.one_of()": ("one_of() without the random stream", "one_of(rng)"),
    "model.houses[0].mind.leave_all_groups()": ("the mind of an agent of 'houses'", "mind="),
    "model.houses[0].run_plan(model, rng)": ("run_plan() of an agent of 'houses'", "a mind"),
    "person.run_plan()": ("run_plan() with other arguments", "run_plan(model, rng)"),
    "person.hatch(copy=True)": ("hatch(copy=…)", "keep_groups"),
    "person.mind.think()": ("the mind's think()", "there is"),
    "person.mind.get_cogniton_value(3)": ("as the name of a cogniton", "as a text"),
    "person.mind.get_cogniton_value()": ("0 arguments", "docs/"),
    "person.mind.set_cogniton_value('Hunger', 'x')": ("the text 'x'", "a number"),
    "x = rng.choice(model.persons)": ("rng.choice() of the population", "one_of(rng)"),
    "x = rng.choice(TABLE)": ("'TABLE', which is of the type list", "a tuple"),
    "x = rng.choice(PAIRS)": ("2 values as the variable", "x, y ="),
    "x = rng.choice(NAMES)": ("rng.choice() of texts", "draw a number"),
    "x = rng.choice((1, 2), (1, 2))": ("rng.choice() like this", "p=weights"),
    "x = rng.choice((1, 2), p=(1, 2, 3))": ("3 weights for 2 values", "each value"),
    "x = rng.choice(person.i, p=(1, 2))": ("another number", "len(weights)"),
    "x = rng.choice((1, 2), p=PAIRS)": ("a tuple of 2 as the weights", "numbers"),
    "x = rng.permutation(3)": ("as a value", "for k in rng.permutation(n)"),
    "rng.shuffle(PAIRS)": ("rng.shuffle() of a tuple of 2", "an array field"),
    "rng.shuffle(model.persons)": ("rng.shuffle() of the population", "by themselves"),
    "person.i = rng.poisson(lam=3)": ("rng.poisson() with lam=", "rng.poisson(mean)"),
    "person.f = rng.gamma(2)": ("1 arguments for rng.gamma()", "rng.gamma(shape, scale)"),
    "x = PAIRS": ("a tuple of 2 as the variable", "where it is used"),
    "x = PAIRS[0]": ("2 values as the variable", "x, y ="),
    "for x in PAIRS:\n        pass": ("2 values for one variable", "`for x, y in …:`"),
    "for x, y, z in PAIRS:\n        pass": ("2 values for 3 variables", "2 variables"),
    "for x, y in model.persons:\n        pass": ("an agent of 'persons' for 2", "loop over one"),
    "for x in NAMES:\n        pass": ("a for loop over texts", "rules hold no texts"),
    "person.i = NAMES[0]": ("a place in a tuple of texts", "elif"),
    "PAIRS[0] = 3": ("a new value for a place of a tuple", "an array field"),
    "PAIRS[0][1] = 3": ("a new value for a place of 2 values", "an array field"),
    "person.i = PAIRS[2][0]": ("the place 2 of a tuple of 2", "0 … 1"),
    "person.i = PAIRS[0][person.i]": ("a place of 2 values that depends", "take them apart"),
    "person.i = RAGGED[0]": ("its tuples differ in length", "equal length"),
    "person.i = BIG[0]": ("more than 1000 numbers", "array fields"),
    "for x in (1, True):\n        pass": ("not of one kind", "one kind"),
    "x = sum(PAIRS)": ("the sum of a tuple of 2", "for loop"),
    "rng.randint(1, 6)": ("rng.randint()", "rng.integers("),
    "rng.gauss(0, 1)": ("rng.gauss()", "rng.normal("),
    "rng.randm()": ("rng.randm()", "did you mean 'random'?"),
    "person.i = rng.integers(0.5)": ("a fraction for rng.integers()", "int("),
    "person.f = rng.uniform(low=0, high=1)": ("rng.uniform() with low=", "without"),
    "person.f = rng.uniform(0, 1, 2)": ("3 arguments for rng.uniform()", "rng.uniform(low, high)"),
    "person.f = model.world.wide": ("the world's 'wide'", "did you mean 'width'?"),
    "model.world.jump(person)": ("the world's jump()", "there is"),
    "x = model.world.patches": ("the world's 'patches' as a value", "for patch in"),
    "x = model.world.in_radius(person, 2)": ("a set of patches as the var", "where it is used"),
    "model.world.face(person)": ("face() without x, y", "a value"),
    "model.world.patch(1).grass = 3": ("1 arguments for patch()", "docs/rules.md"),
    "model.world.patch(1, 1).gras = 3": ("the unknown field 'gras'", "did you mean 'grass'?"),
    "model.world.patch(1, 1).x = 3": ("a new value for 'x'", "cannot be set"),
    "for p in model.world.in_radius(3, 2):\n        pass": ("in_radius() of a whole", "an agent"),
    "for p in model.world.in_radius(person):\n        pass": ("in_radius() like", "agent, radius"),
    "x = 99999999999999999999": ("the number 99999999999999999999", "a float"),
    "x = 3j": ("3j", "a number"),
    "return person.f": ("which returns a number", "into a field"),
    "while person.b:\n        x = 1\n    person.f = x": ("not every way", "the loop"),
    "await person.f": ("await", "run to their end"),
    # what one misses who comes from NetLogo, Mesa or NumPy
    "self.f = 3": ("the unknown name 'self'", "write person.…"),
    "agent.f = 3": ("the unknown name 'agent'", "write person.…"),
    "person.f = price": ("the unknown name 'price'", "write model.price"),
    "person.f = heading": ("the unknown name 'heading'", "write person.heading"),
    "person.plan = grow": ("the unknown name 'grow'", "as a text: 'grow'"),
    "person.b = true": ("the unknown name 'true'", "write True"),
    "person.f = pi": ("the unknown name 'pi'", "math.pi"),
    "person.f = sqrt(2)": ("the unknown function 'sqrt'", "math.sqrt"),
    "forward(1)": ("the unknown function 'forward'", "model.world.forward(person"),
    "ask(model.persons)": ("the unknown function 'ask'", "for other in model.persons:"),
    "walk(person)": ("the unknown function 'walk'", "`def walk(…):`"),
    "person.f = person.pos[0]": ("the unknown field 'pos'", "person.x and person.y"),
    "person.f = person.model.price": ("the unknown field 'model'", "write model.…"),
    "person.f = person.random.random()": ("the unknown field 'random'", "rng.random()"),
    "person.i = person.unique_id": ("the unknown field 'unique_id'", "person.id"),
    "person.name = 'anna'": ("the unknown field 'name'", "fields hold numbers"),
    "person.rich = True": ("the unknown field 'rich'", "`rich: bool = False`"),
    "person.move_to(1, 2)": ("move_to() of an agent", "model.world.move_to(person"),
    "person.remove()": ("remove() of an agent", "person.die()"),
    "model.warmth = 1": ("the model's 'warmth'", "class of the model: `warmth: float = 0.0`"),
    "model.warmht += 0.5": ("which it does not declare", "`warmht: float = 0.0`"),
    "person.f = model.wra": ("the model's 'wra'", "did you mean 'war'? If not, declare"),
    "model.schedule.add(person)": ("the model's 'schedule'", "for other in model.persons:"),
    "model.grid.move_agent(person, 1)": ("the model's 'grid'", "model.world"),
    "person.f = model.random.random()": ("the model's 'random'", "rng.random()"),
    "person.f = model.steps": ("the model's 'steps'", "model.tick"),
    "person.f = model.patches": ("the model's 'patches'", "model.world.patches"),
    "model.persons.remove(person)": ("remove() of the population", "agent.die()"),
    "person.i = model.persons.count()": ("count() of the population", "len(model.persons)"),
    "model.persons.f += 1": ("'f' of the population", "for other in model.persons:"),
    "if model.persons:\n        pass": ("the population 'persons' as", "len(model.persons) > 0"),
    "person.f = model.world.breadth": ("the world's 'breadth'", "there is size, low"),
    "for p in model.world.neighbors(person):\n        pass": (
        "the world's neighbors()",
        "model.world.neighbours(person)",
    ),
    "model.world.patch(0, 0).sugar = 1": ("the unknown field 'sugar'", "class of the patches"),
    "person.i = model.persons[0]": ("an agent of 'persons' for", "its identity"),
    "person['f'] = 3": ("[…] on an agent", "after a dot"),
    "person.f = person.vf.sum()": (".sum()", "sum(array)"),
    "person.die": ("the unknown field 'die'", "write person.die()"),
    "person.hatch(3)": ("hatch() of several", "`for k in range(3): person.hatch()`"),
    "model.persons.create(2)": ("create() of several", "for k in range(2): new = model.persons"),
    "model.persons.create(f=2)": ("create() with f=", "then `new.f = …`"),
    "for p in enumerate(model.persons):\n        pass": ("enumerate()", "count in a variable"),
    "person.f = model.world[1, 1]": ("[…] on the world", "model.world.patch(x, y)"),
    "person.i = model.next_id()": ("next_id() of the model", "person.id"),
    "model.running = False": ("the model's 'running'", "until `stop_when`"),
    "person.b = (0, person.i) in PAIRS": (
        "`in` a tuple of pairs",
        "`for a, b in PAIRS:` with `if a == 0 and b == person.i: found = True`",
    ),
    "person.b = person.i in PAIRS": ("`in` a tuple of pairs", "for a, b in PAIRS:"),
    "person.b = (person.i, 1) == (0, 1)": ("several values in a comp", "`x == 0 and y == 1`"),
    "person.b = PAIRS[0] == PAIRS[1]": ("several values in a comp", "`x == 0 and y == 1`"),
    "person.f = rng.normal()": ("0 arguments for rng.normal()", "rng.normal(mean, deviation)"),
}


@pytest.fixture
def refusal(society, speeds, tmp_path):
    """Give the error of a model whose rules are a text."""

    def of(text, name="rule", compiled=True, phase=None):
        file = tmp_path / "model.py"
        file.write_text(HEAD + text)
        module = speeds.load(file)
        rule = getattr(module, name)
        declared = each(society.Society.persons, rule) if phase is None else phase(rule)
        with pytest.raises(ModelError) as caught:
            type("Refused", (society.Society,), {"schedule": (declared,)})(compiled=compiled)
        error = caught.value
        assert error.file == str(file)
        assert str(error).startswith(f"{file}:{error.line}: ")
        return error, file.read_text().splitlines()[error.line - 1]

    return of


@pytest.mark.parametrize("statement", STATEMENTS)
def test_statements_refused_with_advice(statement, refusal):
    found, advice = STATEMENTS[statement]
    if statement.startswith("await"):
        text = f"async def rule(person, model, rng):\n    {statement}\n"
        error, _ = refusal(text)
        assert "async" in error.found
        return
    error, line = refusal(f"def rule(person, model, rng):\n    {statement}\n")
    assert found in error.found
    assert advice in error.remedy
    # The line is one of the statement's, or that of the rule when the rule as a whole is at fault.
    assert line.strip() in [*(part.strip() for part in statement.splitlines()), line.strip()]
    assert line.strip() in statement or line.startswith("def rule")


def test_interpreted_runs_refuse_alike(refusal):
    for statement in ("x = [1]", "person.f = None", "person.f = wheat"):
        text = f"def rule(person, model, rng):\n    {statement}\n"
        assert str(refusal(text)[0]) == str(refusal(text, compiled=False)[0])


DEFINITIONS = {
    "def rule(person, *rest):\n    pass": "*arguments",
    "def rule(person, **rest):\n    pass": "**arguments",
    "def rule(person, *, model):\n    pass": "keyword-only parameters",
    "def rule(person, /, model):\n    pass": "positional-only parameters",
    "def rule(person, wheat):\n    pass": "the parameter 'wheat'",
    "def rule():\n    pass": "without parameters",
    "rule = lambda person: None": "a lambda",
    "async def rule(person):\n    pass": "an async rule",
    "def _ordinary(f):\n    return f\n\n@_ordinary\ndef rule(person):\n    pass": "a decorator",
    "import functools\n@functools.cache\ndef rule(person):\n    pass": "inside a decorator",
    "import functools\ndef r(person, x):\n    pass\nrule = functools.partial(r, x=1)": "as a rule",
    "class Mind:\n    def live(self):\n        pass\nrule = Mind().live": "as a rule",
    "def make(k):\n    def rule(person):\n        person.f = k\n    return rule\nrule = make(1)": (
        "inside another function"
    ),
    "def rule(person):\n    again(person)\ndef again(person):\n    rule(person)": "calls itself",
    "def rule(person):\n    rule(person)": "calls itself",
    "def rule(person):\n    person.i = part(person)\ndef part(person):\n"
    "    if person.b:\n        return 1": "on some ways only",
    "def rule(person):\n    person.f = part(person)\ndef part(person):\n"
    "    if person.b:\n        return 1\n    return True": "where another line returns",
    "def rule(person):\n    part(person, 1)\ndef part(person, _x):\n    pass": "the parameter '_x'",
    "def rule(person):\n    person.plan = a()\ndef a():\n    return 'grow'": "a text returned",
    "def rule(person):\n    part(person)\ndef part(person, x=None):\n    pass": "which is None",
    "def rule(person):\n    part(person)\ndef part(person, x=[]):\n    pass": "of the type list",
}


@pytest.mark.parametrize("text", DEFINITIONS)
def test_definitions_refused_with_advice(text, refusal):
    error, _ = refusal(text + "\n")
    assert DEFINITIONS[text] in error.found
    assert error.remedy


PARAMETERS = {
    "def rule(person):\n    person.f = model.price": "`def rule(person, model)`",
    "def rule(person):\n    model.total += 1": "`def rule(person, model)`",
    "def rule(person):\n    person.f = rng.random()": "`def rule(person, rng)`",
    "def rule(person):\n    model.total += rng.random()": "`def rule(person, model, rng)`",
    "def rule(person, rng):\n    for p in model.persons:\n        p.f = 1": (
        "`def rule(person, rng, model)`"
    ),
    "def rule(person):\n    person.f = person.model.price": "`def rule(person, model)`",
    "def rule(person):\n    person.f = price": "`def rule(person, model)`",
    "def rule(person):\n    part(person)\ndef part(person, k=1):\n    person.f = model.price": (
        "`def part(person, model, k=…)`, and give it model where it is called"
    ),
    "def rule(model):\n    model.total = 1": "`def rule(agent, model)`, or schedule it by once(…)",
    "def rule(model, person):\n    person.f = 1": "def rule(person, model)",
    "def rule(person, modl):\n    pass": "did you mean 'model'?",
    "def rule(person, world):\n    pass": "write model.world",
}


@pytest.mark.parametrize("text", PARAMETERS)
def test_parameters_that_a_rule_lacks(text, refusal):
    error, _ = refusal(text + "\n")
    assert PARAMETERS[text] in error.remedy


def test_a_decorator_that_hides_the_rule(refusal):
    text = (
        "import functools\n\n\ndef loud(f):\n    @functools.wraps(f)\n    def inner(*a):\n"
        "        return f(*a)\n    return inner\n\n\n@loud\ndef rule(person):\n    pass\n"
    )
    error, line = refusal(text)
    assert "decorator" in error.found
    assert "decorator" in error.remedy
    assert line in ("@loud", "def rule(person):")


def _live(person, model, rng):
    person.run_plan(model, rng)


def _onward(person, model, rng):
    _live(person, model, rng)


def test_a_plan_that_carries_out_plans(society):
    plans = {"grow": _onward, "trade": society.trade, "rest": society.rest}
    crowd = society.Population(society.Person, 3, mind=society.SCHEME, plans=plans)
    with pytest.raises(ModelError, match=r"carries out its plan|calls itself"):
        type(
            "Endless",
            (society.Model,),
            {"crowd": crowd, "schedule": (each(crowd, _live),)},
        )()


def test_a_name_that_the_scheme_does_not_have(refusal):
    error, line = refusal(
        "def rule(person):\n    person.f = 1\n    person.mind.activate_cogniton('Hungre')\n"
    )
    assert "the cogniton 'Hungre'" in error.found
    assert error.remedy == "did you mean 'Hunger'?"
    assert line.strip() == "person.mind.activate_cogniton('Hungre')"


def test_a_rule_without_a_file(society):
    space = {}
    exec("def rule(person):\n    person.f = 1", space)
    with pytest.raises(ModelError, match="whose text Python did not keep") as caught:
        type(
            "Made",
            (society.Society,),
            {"schedule": (each(society.Society.persons, space["rule"]),)},
        )()
    assert "save the model in a file" in caught.value.remedy


def test_a_file_that_has_changed_since_it_was_loaded(society, speeds, tmp_path):
    file = tmp_path / "model.py"
    file.write_text("def rule(person):\n    person.f = 1\n")
    rule = speeds.load(file).rule
    moved = type("Moved", (society.Society,), {"schedule": (each(society.Society.persons, rule),)})
    file.write_text("def other(person, k):\n    person.g = k\n\n\n" + file.read_text())
    moved(compiled=False).advance(1)  # the same, some lines below
    file.write_text(file.read_text().replace("person.f = 1", "person.f = 2"))
    with pytest.raises(ModelError, match="it has changed since: load the model again"):
        type("Old", (society.Society,), {"schedule": (each(society.Society.persons, rule),)})()


def test_a_rule_of_a_notebook(society, speeds):
    import linecache

    text = "def rule(person):\n    person.f = 1\n    person.wheat = 2\n"
    linecache.cache["<cell 3>"] = (len(text), None, text.splitlines(True), "<cell 3>")
    space = {"__name__": "__main__"}
    exec(compile(text, "<cell 3>", "exec"), space)
    with pytest.raises(ModelError, match="the unknown field 'wheat'") as caught:
        type(
            "Cell",
            (society.Society,),
            {"schedule": (each(society.Society.persons, space["rule"]),)},
        )()
    assert (caught.value.file, caught.value.line) == ("<cell 3>", 3)


def test_a_rule_once_a_tick_takes_no_agent(refusal):
    error, _ = refusal("def rule(person, model):\n    pass\n", phase=once)
    assert "the parameter 'person'" in error.found


def test_every_refusal_has_advice():
    tables = [NAMES, MODULES, METHODS, MATH_REMEDIES]
    advice = [text for table in tables for text in table.values()]
    advice += [remedy for _, remedy in REFUSED.values()]
    assert all(len(text) > 3 for text in advice)
    assert len(OPERATORS) == 7
