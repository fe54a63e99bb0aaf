"""Random rules: text of functions over the society of `rules/society.py`."""

import random

FLOATS = ("0.0", "1.0", "-1.5", "0.1", "2.5", "1e-3", "3.0", "-0.0", "1e16", "0.5", "7.25")
ODD_FLOATS = ("math.inf", "-math.inf", "math.nan", "1e308", "5e-324", "9007199254740993.0", "1e19")
INTS = ("0", "1", "2", "3", "-1", "-7", "10", "255", "1_000_003")
ODD_INTS = ("2 ** 53", "9_223_372_036_854_775_807", "-9_223_372_036_854_775_807", "2 ** 31")
TAMED = ("math.sin", "math.cos", "math.atan", "math.tanh", "abs", "math.radians", "math.fabs")
PLANS = ('"grow"', '"trade"', '"rest"')
COGNITONS = ('"Hunger"', '"Greed"', '"Sloth"', '"Means"')
TABLES = """\
PAIRS = ((0, 1), (1, 0), (0, -1), (-1, 0))
ROWS = ((1, 0.5, True), (2, 1.5, False), (-3, 2, True))
NUMBERS = (0.5, -1.25, 3.0, 1e16, 0.1)
COUNTS = (3, 0, 1, 7)
WEIGHTS = (1, 0, 2.5)
"""


class Author:
    """Writes one rule and its helpers; equal seeds write equal rules.

    Args:
        seed: any number.
        number: what tells the names of this rule's functions from another's.
    """

    def __init__(self, seed, number):
        self.random = random.Random(f"{seed} {number}")
        self.number = number
        self.depth = 0
        self.loops = 0
        self.agents = ["person"]
        self.floats = ["a", "b"]
        self.ints = ["m", "n"]
        self.counters = []
        self.bools = ["p"]

    def one(self, *choices):
        return self.random.choice(choices)()

    def pick(self, *choices):
        return self.random.choice(choices)

    # Expressions

    def float(self, depth=0):
        if depth > 3 or self.random.random() < 0.25:
            return self.float_atom()
        d = depth + 1
        f, i, b = (lambda: self.float(d)), (lambda: self.int(d)), (lambda: self.bool(d))
        return self.one(
            lambda: f"({f()} {self.pick('+', '-', '*')} {f()})",
            lambda: f"({f()} {self.pick('+', '-', '*')} {i()})",
            lambda: f"({i()} / {self.divisor(i())})",
            lambda: f"({f()} {self.pick('/', '//', '%')} {self.divisor(f())})",
            lambda: f"({f()} % {self.divisor(i())})",
            lambda: f"-{f()}",
            lambda: f"{self.pick(*TAMED)}({f()})",
            lambda: f"{self.pick('min', 'max')}({f()}, {f()})",
            lambda: f"{self.pick('min', 'max')}({i()}, {f()}, {f()})",
            lambda: f"({f()} if {b()} else {f()})",
            lambda: f"({f()} if {b()} else {i()})",
            lambda: f"abs({f()}) ** {self.pick('2', '0.5', '3', '1.7')}",
            lambda: f"{self.divisor(f())} ** -1",
            lambda: f"math.sqrt(abs({f()}))",
            lambda: f"math.hypot({f()}, {f()})",
            lambda: f"math.atan2({f()}, {f()})",
            lambda: f"math.log(1 + abs({f()}))",
            lambda: f"math.exp(-abs({f()}))",
            lambda: f"sum({self.agent()}.vf)",
            lambda: f"{self.pick('min', 'max')}({self.agent()}.vf)",
            lambda: f"float({i()})",
            lambda: f"mean_{self.number}({f()}, {f()})",
            lambda: f"mean_{self.number}({i()}, y={f()})",
            lambda: "rng.random()",
            lambda: f"rng.uniform({f()}, {f()})",
            lambda: "rng.normal(0, 1)",
            lambda: f"rng.exponential(abs({i()}) % 9)",
            lambda: f"rng.gamma(0.1 + abs({i()}) % 9, {self.pick('1.5', '0', '0.25')})",
            lambda: f"rng.choice({self.pick('NUMBERS', '(0.5, 1, 2)', 'person.vf')})",
            lambda: f"rng.choice({self.agent()}.vf)",
            lambda: f"rng.choice((0.5, 1, 2), p={self.pick('WEIGHTS', '(0, 0, 1)', 'person.vb')})",
            lambda: f"NUMBERS[{self.place(5)}]",
            lambda: f"ROWS[{self.place(3)}][1]",
            lambda: f"{self.pick('min', 'max', 'sum')}(NUMBERS)",
            lambda: f"float(m in COUNTS) * {f()}",
            lambda: f"weighed_{self.number}(rng, {self.pick('NUMBERS', '(1.5, 2)')})",
            lambda: f"model.world.distance(person, {f()} % 9, {f()} % 9)",
            lambda: f"model.world.towards(person, {f()} % 9, {f()} % 9)",
            lambda: f"model.world.patch({f()} % 9, {f()} % 9).grass",
            lambda: f"{self.agent()}.mind.get_cogniton_value({self.pick(*COGNITONS)})",
        )

    def float_atom(self):
        return self.one(
            lambda: self.pick(*self.floats),
            lambda: f"{self.agent()}.{self.pick('f', 'g', 'x')}",
            lambda: f"{self.agent()}.vf[{self.place(4)}]",
            lambda: self.pick(*FLOATS),
            lambda: self.pick(*(ODD_FLOATS if self.random.random() < 0.2 else FLOATS)),
            lambda: self.pick("model.price", "model.total", f"model.board[{self.place(3)}]"),
        )

    def int(self, depth=0):
        if depth > 3 or self.random.random() < 0.3:
            return self.int_atom()
        d = depth + 1
        f, i, b = (lambda: self.float(d)), (lambda: self.int(d)), (lambda: self.bool(d))
        return self.one(
            lambda: f"({i()} {self.pick('+', '-', '*')} {i()})",
            lambda: f"({i()} {self.pick('//', '%')} {self.divisor(i())})",
            lambda: f"({i()} {self.pick('//', '%')} {self.pick('3', '-4', '7')})",
            lambda: f"-{i()}",
            lambda: f"abs({i()})",
            lambda: f"{self.pick('min', 'max')}({i()}, {i()})",
            lambda: f"({i()} if {b()} else {i()})",
            lambda: f"({i()} % 5) ** {self.pick('2', '3', '0')}",
            lambda: f"{self.pick('int', 'round', 'math.floor', 'math.ceil')}({f()})",
            lambda: f"({b()}) + {i()}",
            lambda: f"sum({self.agent()}.{self.pick('vi', 'vb')})",
            lambda: f"{self.pick('min', 'max')}({self.agent()}.vi)",
            lambda: f"half_{self.number}({i()})",
            lambda: f"rng.integers({self.pick('6', '-3, 4', '100')})",
            lambda: f"int({b()})",
            lambda: f"rng.poisson(abs({i()}) % {self.pick('9', '60')})",
            lambda: f"rng.choice({self.pick('COUNTS', '(1, 2)', '7', 'person.vi')})",
            lambda: f"rng.choice(COUNTS, p={self.pick('COUNTS', '(1, 2.5, 0, 1)', 'person.vf')})",
            lambda: f"rng.choice(3, p={self.pick('WEIGHTS', 'person.vb')})",
            lambda: f"COUNTS[{self.place(4)}]",
            lambda: f"PAIRS[{self.place(4)}][{self.pick('0', '1', '-1')}]",
            lambda: f"{self.pick('min', 'max', 'sum', 'len')}(COUNTS)",
            lambda: f"best_{self.number}({i()}, {self.pick('PAIRS', '((1, 5), (2, 3))')})",
            lambda: "model.world.patch(person.x, person.y).visits",
        )

    def int_atom(self):
        return self.one(
            lambda: self.pick(*self.ints, *self.counters),
            lambda: f"{self.agent()}.{self.pick('i', 'j', 'small', 'id')}",
            lambda: f"{self.agent()}.vi[{self.place(5)}]",
            lambda: self.pick(*INTS),
            lambda: self.pick(*(ODD_INTS if self.random.random() < 0.15 else INTS)),
            lambda: self.pick("model.count", "model.years", "model.tick", "len(model.houses)"),
        )

    def bool(self, depth=0):
        if depth > 3 or self.random.random() < 0.2:
            return self.pick(
                *self.bools, f"{self.agent()}.b", f"{self.agent()}.vb[{self.place(3)}]"
            )
        d = depth + 1
        f, i, b = (lambda: self.float(d)), (lambda: self.int(d)), (lambda: self.bool(d))
        test = self.pick("<", "<=", ">", ">=", "==", "!=")
        return self.one(
            lambda: f"({f()} {test} {f()})",
            lambda: f"({i()} {test} {i()})",
            lambda: f"({i()} {test} {f()})",
            lambda: f"({f()} < {f()} {test} {f()})",
            lambda: f"({b()} {self.pick('and', 'or')} {b()})",
            lambda: f"(not {b()})",
            lambda: f"bool({f()})",
            lambda: f"({b()} {self.pick('==', '!=')} {b()})",
            lambda: f"({self.agent()}.oi is {self.pick('None', 'not None')})",
            lambda: f"math.isnan({f()})",
            lambda: f"math.isfinite({f()})",
            lambda: f"model.persons.contains({i()})",
            lambda: (
                f"({self.pick('m', 'n')} {self.pick('in', 'not in')} "
                f"{self.pick('COUNTS', '(1, 2, 3)')})"
            ),
            lambda: f"rng.choice({self.pick('(True, False)', 'person.vb')})",
            lambda: f"({self.agent()}.plan {self.pick('==', '!=')} {self.pick(*PLANS)})",
            lambda: f"({self.agent()} {self.pick('is', 'is not', '==', '!=')} {self.agent()})",
            lambda: f"model.world.is_on(person, {f()} % 9, {f()} % 9)",
            lambda: f"({self.agent()}.of is {self.pick('None', 'not None')})",
        )

    def divisor(self, text):
        """Return what is seldom zero."""
        kept = self.random.random()
        if kept < 0.08:
            return f"({text})"
        return f"({self.pick('-', '')}1 - abs({text}))" if kept < 0.3 else f"(1 + abs({text}))"

    def agent(self):
        return self.pick(*self.agents)

    def place(self, size):
        return self.pick(
            str(self.random.randrange(-size, size)),
            f"{self.pick(*self.ints, *self.counters)} % {size}",
        )

    # Statements

    def block(self, indent, inside_loop=False):
        lines = []
        for _ in range(self.random.randint(1, 3)):
            lines += self.statement(indent, inside_loop)
        return lines

    def statement(self, indent, inside_loop):
        pad = "    " * indent
        deep = self.depth > 2
        simple = (
            lambda: [
                f"{pad}{self.pick(*self.floats)} {self.pick('=', '+=', '-=', '*=')} {self.float()}"
            ],
            lambda: [f"{pad}{self.pick(*self.ints)} = {self.int()}"],
            lambda: [f"{pad}{self.pick(*self.ints)} {self.pick('+=', '-=', '*=')} {self.int(2)}"],
            lambda: [f"{pad}m {self.pick('%=', '//=')} {self.divisor(self.int(2))}"],
            lambda: [f"{pad}p = {self.bool()}"],
            lambda: [
                f"{pad}{self.agent()}.{self.pick('f', 'g')} "
                f"{self.pick('=', '+=', '*=')} {self.float()}"
            ],
            lambda: [
                f"{pad}{self.agent()}.{self.pick('i', 'j')} {self.pick('=', '+=')} {self.int()}"
            ],
            lambda: [f"{pad}{self.agent()}.{self.pick('b', 'c')} = {self.bool()}"],
            lambda: [f"{pad}{self.agent()}.small = ({self.int()}) % 30_000"],
            lambda: [
                f"{pad}{self.agent()}.vf[{self.place(4)}] {self.pick('=', '+=')} {self.float()}"
            ],
            lambda: [f"{pad}{self.agent()}.vi[rng.integers(5)] += ({self.int()}) % 100"],
            lambda: [f"{pad}{self.agent()}.vb[{self.place(3)}] = {self.bool()}"],
            lambda: [f"{pad}{self.agent()}.oi = {self.pick('None', self.int())}"],
            lambda: [f"{pad}if person.oi is not None:", f"{pad}    m += person.oi % 1_000"],
            lambda: [f"{pad}a, b = b, {self.float()}"],
            lambda: [f"{pad}m, a = {self.int()}, {self.float()}"],
            lambda: [f"{pad}model.total += {self.float()}"],
            lambda: [f"{pad}model.persons.one_of(rng).f += {self.float(2)}"],
            lambda: [f"{pad}model.world.patch(person.x, person.y).grass += {self.float()}"],
            lambda: [f"{pad}model.world.forward(person, {self.float(2)} % 5)"],
            lambda: [
                f"{pad}model.world.{self.pick('right', 'left')}(person, {self.float(2)} % 99)"
            ],
            lambda: [f"{pad}model.world.face(person, {self.float(2)} % 9, {self.float(2)} % 9)"],
            lambda: [f"{pad}model.world.move_to(person, {self.float(2)} % 9, {self.float(2)} % 9)"],
            lambda: [f"{pad}model.world.walk_to(person, {self.float(2)} % 9, b % 9, 0.5)"],
            lambda: [f"{pad}rng.shuffle({self.agent()}.{self.pick('vf', 'vi', 'vb')})"],
            lambda: [f"{pad}rng.shuffle(model.board)"],
            lambda: [f"{pad}model.board[{self.place(3)}] {self.pick('=', '+=')} {self.float(2)}"],
            lambda: [f"{pad}model.last = {self.pick('None', self.int(2))}"],
            lambda: [f"{pad}if model.last is not None:", f"{pad}    n += model.last % 100"],
            lambda: [f"{pad}person.of = {self.pick('None', self.float(2))}"],
            lambda: [f"{pad}if person.of is not None:", f"{pad}    a += person.of"],
            lambda: [f"{pad}person.tiny = ({self.int(2)}) % 120"],
            lambda: [f"{pad}n, m = {self.pick('PAIRS', '((5, 6), (7, 8))')}[{self.place(2)}]"],
            lambda: [f"{pad}n, b, p = ROWS[{self.place(3)}]"],
            lambda: [f"{pad}n, m = rng.choice(PAIRS{self.pick('', ', p=COUNTS')})"],
            lambda: [f"{pad}person.plan = person.mind.choose_next_plan()"],
            lambda: [f"{pad}person.plan = {self.pick(*PLANS, 'None')}"],
            lambda: [
                f"{pad}person.mind.{self.pick('set_cogniton_value', 'add_to_cogniton_value')}"
                f"({self.pick(*COGNITONS)}, {self.float(2)} % 10)"
            ],
            lambda: [
                f"{pad}if person.plan is not None:",
                f"{pad}    person.mind.feed_back_from_plan(person.plan, {self.float(2)} % 2)",
            ],
            lambda: [f"{pad}model.houses[{self.place(3)} % 3].rent += {self.float(2)}"],
            lambda: [
                f"{pad}if len(model.persons) > 4 and {self.bool(2)}:",
                f"{pad}    model.persons.one_of(rng).die()",
            ],
        )
        loops = (
            ()
            if deep
            else (lambda: self.branch(indent, inside_loop),) * 4
            + (
                lambda: self.count(indent),
                lambda: self.search(indent),
                lambda: self.visit(indent),
                lambda: self.table(indent),
                lambda: self.around(indent),
            )
        )
        ends = (
            (lambda: [f"{pad}if {self.bool()}:", f"{pad}    {self.pick('break', 'continue')}"],)
            if inside_loop
            else (lambda: [f"{pad}if {self.bool()}:", f"{pad}    return"],)
        )
        return self.one(*simple, *loops, *ends)

    def nested(self, indent, inside_loop):
        self.depth += 1
        lines = self.block(indent + 1, inside_loop)
        self.depth -= 1
        return lines

    def branch(self, indent, inside_loop):
        pad = "    " * indent
        lines = [f"{pad}if {self.pick(self.bool(), self.float(2), self.int(2))}:"]
        lines += self.nested(indent, inside_loop)
        if self.random.random() < 0.3:
            lines += [f"{pad}elif {self.bool()}:", *self.nested(indent, inside_loop)]
        if self.random.random() < 0.5:
            lines += [f"{pad}else:", *self.nested(indent, inside_loop)]
        return lines

    def count(self, indent):
        pad = "    " * indent
        self.loops += 1
        k = f"k{self.loops}"
        bounds = self.pick("3", f"{self.pick(*self.ints)} % 6", "1, 7, 2", "4, -3, -2")
        self.counters.append(k)
        body = self.nested(indent, inside_loop=True)
        self.counters.remove(k)
        lines = [f"{pad}for {k} in range({bounds}):", f"{pad}    n += 1", *body]
        if self.random.random() < 0.2:
            lines += [f"{pad}else:", *self.nested(indent, False)]
        return lines

    def search(self, indent):
        pad = "    " * indent
        self.loops += 1
        w = f"w{self.loops}"
        lines = [f"{pad}{w} = 0", f"{pad}while {w} < 5 and {self.bool()}:", f"{pad}    {w} += 1"]
        return lines + self.nested(indent, inside_loop=True)

    def visit(self, indent):
        pad = "    " * indent
        self.loops += 1
        other = f"other{self.loops}"
        self.agents.append(other)
        body = self.nested(indent, inside_loop=True)
        self.agents.remove(other)
        return [f"{pad}for {other} in model.persons:", *body]

    def table(self, indent):
        """Return a loop over a table or in a random order."""
        pad = "    " * indent
        self.loops += 1
        k, y, z = (f"{name}{self.loops}" for name in "kyz")
        head, counters = self.pick(
            (f"for {k} in rng.permutation({self.pick('4', f'{self.pick(*self.ints)} % 6')}):", [k]),
            (f"for {k} in {self.pick('COUNTS', '(4, 2, 2)')}:", [k]),
            (f"for {k}, {y} in PAIRS:", [k, y]),
            (f"for {k}, {y}, {z} in ROWS:", [k]),
        )
        self.counters += counters
        body = self.nested(indent, inside_loop=True)
        for name in counters:
            self.counters.remove(name)
        return [pad + head, f"{pad}    n += {k}", *body]

    def around(self, indent):
        pad = "    " * indent
        self.loops += 1
        p = f"patch{self.loops}"
        return [
            f"{pad}for {p} in model.world.in_radius({self.agent()}, {self.pick('1', '2.5')}):",
            f"{pad}    {p}.grass {self.pick('+=', '*=', '=')} {self.float(2)}",
            f"{pad}    {p}.visits = ({self.int(2)}) % 100",
            f"{pad}    {p}.owner = {self.pick('None', self.int(2))}",
            f"{pad}    if {p}.taken or {self.bool(2)}:",
            f"{pad}        {p}.taken = {self.bool(2)}",
            f"{pad}        {self.pick('break', 'continue')}",
        ]

    def rule(self):
        number = self.number
        body = []
        for _ in range(self.random.randint(4, 8)):
            body += self.statement(1, inside_loop=False)
        return [
            f"def mean_{number}(x, y):",
            f"    if x {self.pick('<', '>=', '==')} y:",
            "        return x",
            f"    return {self.pick('(x + y) / 2', 'x * 0.5 + y', 'x - y')}",
            "",
            f"def half_{number}(k):",
            f"    return {self.pick('k // 2', 'k % 10', 'k - k // 3')}",
            "",
            f"def weighed_{number}(rng, values):",
            f"    return rng.choice(values) {self.pick('+', '*')} sum(values)",
            "",
            f"def best_{number}(k, pairs):",
            "    found = -1",
            "    for x, y in pairs:",
            f"        if {self.pick('x < y', 'x == k', 'y * k > 2')}:",
            "            found = x - y",
            f"    return found + pairs[k % len(pairs)][{self.pick('0', '1')}]",
            "",
            f"def rule_{number}(person, model, rng):",
            "    a = person.f",
            f"    b = {self.pick('0', '1.5', 'person.i')}",
            "    m = person.i",
            "    n = 0",
            "    p = person.b",
            *body,
            "    person.g = a - b",
            "    person.j = m",
            "    person.c = p",
            "",
        ]


def module_text(seed, count):
    """Return the text of a module with so many random rules."""
    lines = ["import math", "", TABLES, ""]
    for number in range(count):
        lines += [*Author(seed, number).rule(), ""]
    lines += ["def at(person, model, rng):"]
    for number in range(count):
        lines += [f"    if model.case == {number}:", f"        rule_{number}(person, model, rng)"]
    return "\n".join(lines) + "\n"
