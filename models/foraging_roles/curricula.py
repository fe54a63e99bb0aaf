"""Ways to teach roles, by name: `socialmind learn foraging_roles --lesson supervised_role`.

The first is what is taught where none is named: judged by what robots bring home, CollectSelect
learned before. The model's own mind was learned by `supervised_role`, whose loss counts the
variable ROLE.
"""

from .lessons import curriculum
from .role_lessons import anew, delivered, narrow, thesis, together

curricula = {
    "delivered_anew": anew,
    "delivered_role": delivered,
    "delivered_narrow": narrow,
    "at_once": together,
    "supervised_role": curriculum,
    "thesis_role": thesis,
}
