"""Which worlds there are: for learning, for choosing and for reporting, and none is in two of them.

Trainings draw worlds of 64 bits from a hash of `TRAINING`, the attempt, the lesson and the
generation; their finals too. What is chosen, such as parameters of a rule, or one of ten attempts,
is chosen in the worlds for choosing. What a page or table says was measured in those for
reporting.

The numbers of the scheme were first chosen in 64 worlds of `REPORTED_ECONOMY`. Chosen anew in those
for choosing (`scheme_scan`) they come out the same to within a world in 320; what is told of the
scheme in the economy was measured in worlds of its own all the same.
"""

TRAINING = 8
"""The seed of trainings."""
CHOOSING = range(3001, 3101)
"""Worlds in bodies in which attempts and parameters are chosen."""
REPORTED = range(6001, 6141)
"""Worlds in bodies of which results tell: the first 20 are those of `analysis/specialisation`, 6021
to 6040 of what was chosen at first, 6051 to 6090 of the second choice, 6101 to 6140 of the third
and of the lessons that `further_worlds` holds beside it."""
CHOOSING_ECONOMY = range(10_000, 10_128)
"""Worlds of the economy in which parameters are chosen."""
REPORTED_ECONOMY = range(256)
"""Worlds of the economy of which results tell where the scheme does not take part."""
SCHEME_ECONOMY = range(20_000, 20_064)
"""Worlds of the economy in which the scheme is judged beside others; nothing was chosen in them."""
