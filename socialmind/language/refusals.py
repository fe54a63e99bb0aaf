"""What the rule language leaves out, and what to write instead."""

from __future__ import annotations

import ast

_REDUCED = (
    "write sum(… for … in … if …), or min, max, any, all, statistics.fmean of it; or a for loop"
)

REFUSED: dict[type[ast.AST], tuple[str, str]] = {
    ast.AsyncFunctionDef: ("an async function", "write a plain function"),
    ast.FunctionDef: ("a function inside a rule", "move it to the top of the file"),
    ast.ClassDef: ("a class inside a rule", "declare agents at the top of the file"),
    ast.Delete: ("del", "set the value to 0 or None; an agent dies with `agent.die()`"),
    ast.AsyncFor: ("async for", "write a plain for loop"),
    ast.With: ("with", "rules open no files; report through `series()` and `agents()`"),
    ast.AsyncWith: ("async with", "rules open no files"),
    ast.Match: ("match", "write if … elif … else"),
    ast.Raise: ("raise", "count the case in a field, and look at it in `series()`"),
    **dict.fromkeys(
        (ast.Try, ast.TryStar),
        ("try", "ask before: `if price > 0:` rather than catching the error after"),
    ),
    ast.Assert: ("assert", "write the case as an if, or check it in a test of the model"),
    **dict.fromkeys(
        (ast.Import, ast.ImportFrom),
        ("import inside a rule", "import at the top of the file (only `math` is for rules)"),
    ),
    ast.Global: ("global", "declare the variable on the model and write `model.name`"),
    ast.Nonlocal: ("nonlocal", "declare the variable on the model and write `model.name`"),
    ast.NamedExpr: (":=", "assign on a line of its own"),
    ast.Lambda: ("lambda", "write a function at the top of the file"),
    ast.Dict: ("a dictionary", "give each entry a field, or use an array field and whole numbers"),
    ast.Set: ("a set", "use an array field of truth values"),
    ast.ListComp: ("a list comprehension", _REDUCED),
    ast.SetComp: ("a set comprehension", _REDUCED),
    ast.DictComp: ("a dictionary comprehension", "write a for loop"),
    ast.GeneratorExp: ("a generator expression on its own", _REDUCED),
    ast.Await: ("await", "rules run to their end at once"),
    **dict.fromkeys((ast.Yield, ast.YieldFrom), ("yield", "return the value")),
    ast.JoinedStr: ("an f-string", "rules hold no texts; print from outside, after `advance()`"),
    ast.FormattedValue: ("an f-string", "rules hold no texts"),
    ast.List: ("a list", "declare an array field: `visits: list[int] = [0] * 9`"),
    ast.Starred: ("*", "write the values out"),
    ast.Slice: ("a slice", "write a for loop over `range(…)`"),
}

OPERATORS: dict[type[ast.AST], str] = {
    ast.BitAnd: "&",
    ast.BitOr: "|",
    ast.BitXor: "^",
    ast.LShift: "<<",
    ast.RShift: ">>",
    ast.Invert: "~",
    ast.MatMult: "@",
}

NAMES: dict[str, str] = {
    "print": "run with --interpreted to print from a rule, or report through `series()`",
    "input": "make it a parameter",
    "open": "rules open no files; report through `series()` and `agents()`",
    "sorted": "keep the best so far in a for loop",
    "reversed": "write `for i in range(n - 1, -1, -1)`",
    "enumerate": "write `for i in range(len(…))`; over agents, count in a variable",
    "zip": "write `for i in range(len(…))`",
    "map": "write a for loop",
    "filter": "write a for loop with an if",
    "list": "declare an array field: `visits: list[int] = [0] * 9`",
    "dict": "give each entry a field",
    "set": "use an array field of truth values",
    "tuple": "write the values out, separated by commas",
    "str": "rules hold no texts; name plans and cognitons as written texts",
    **dict.fromkeys(("isinstance", "type"), "each parameter of a rule has one type"),
    "getattr": "write `agent.field`",
    "setattr": "write `agent.field = value`",
    "hasattr": "every agent of a population has the same fields",
    "divmod": "write `a // b` and `a % b`",
    "pow": "write `a ** b`",
    "eval": "write the expression out",
    "exec": "write the statements out",
    "next": "write a for loop with `break`",
    "iter": "write a for loop",
    "super": "rules are plain functions, without classes",
}

MODULES: dict[str, str] = {
    "numpy": "use `math` and plain numbers inside rules; NumPy works outside them, in `series()`",
    "random": "draw from the rule's stream: `rng.random()`, `rng.integers(6)`, `rng.uniform(0, 1)`",
    "pandas": "rules hold no tables; use pandas on what the run recorded",
    **dict.fromkeys(("time", "datetime"), "the time of the model is `model.tick`"),
    "os": "rules know no files; make it a parameter",
    "sys": "rules know no interpreter; make it a parameter",
}

METHODS: dict[str, str] = {
    "append": "an array field has a fixed size; count in an int field how many places are used",
    "pop": "an array field has a fixed size; count in an int field how many places are used",
    "sort": "keep the best so far in a for loop",
    **dict.fromkeys(("items", "keys"), "rules hold no dictionaries"),
    "choices": "write `rng.choice(values, p=weights)`",
    "expovariate": "write `rng.exponential(mean)`",
    "gammavariate": "write `rng.gamma(shape, scale)`",
    "standard_normal": "write `rng.normal(0, 1)`",
    "permuted": "write `for k in rng.permutation(n):`, or `rng.shuffle(array)`",
    "binomial": "count in a for loop: `if rng.random() < p:`",
    "randint": "write `rng.integers(low, high + 1)`",
    "gauss": "write `rng.normal(mean, deviation)`",
    "rand": "write `rng.random()`",
    "format": "rules hold no texts",
    "sum": "write `sum(array)`",
    "mean": "write `sum(array) / len(array)`",
    "max": "write `max(array)`",
    "min": "write `min(array)`",
    "copy": "copy the places of the array one by one",
}

MATH_REMEDIES: dict[str, str] = {
    "log1p": "write math.log(1 + x)",
    "expm1": "write math.exp(x) - 1",
    "exp2": "write 2.0 ** x",
    "cbrt": "write x ** (1 / 3)",
    "fmod": "write x % y",
    "remainder": "write x - y * round(x / y)",
    "modf": "write x - int(x)",
    "copysign": "write abs(x) if y >= 0 else -abs(x)",
    "isclose": "write abs(a - b) < 1e-9",
    "fsum": "write sum(array)",
    "dist": "write math.hypot(x - a, y - b), or model.world.distance(agent, x, y)",
    "isqrt": "write int(math.sqrt(n))",
    **dict.fromkeys(("prod", "factorial", "comb", "perm"), "multiply in a for loop"),
    "gcd": "write the loop of Euclid: `while b != 0: a, b = b, a % b`",
}
"""Functions of `math` that rules do not have, and what to write instead."""
