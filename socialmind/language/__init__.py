"""The front end of rules: a documented subset of Python, typed once, run at two speeds.

- `source`: a rule's syntax tree with its file and lines.
- `refusals`, `hints`: what the subset leaves out and what to write instead; names of elsewhere.
- `types`, `shape`: what an expression can be; what a model declares.
- `signatures`: what rules may call on a mind, a random stream, a world.
- `expressions` with `attributes`, `operators`, `comparisons`, `calls`, `tables`, and
  `statements` with `loops`: the typing, which puts `arithmetic` where the speeds differ.
- `program`: all functions that a model's phases reach, and the tree that both speeds run.
- `layout`, `lowering`, `access`, `loop`: records and arrays; the same tree for numba; how it
  reaches agents; the tick loop around it.
"""
