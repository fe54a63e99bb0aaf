"""What the thesis reports of robots that learn to collect (chapter 6), beside ours."""

from __future__ import annotations

from functools import partial

from socialmind.experiments.overview import Result

from .figure_findings import avoiding, base_skills, collecting, complex_skills, spent
from .kept_cells import spent_in
from .retraining_findings import power, retraining, shared_draws
from .structure_findings import same_seeds, structures

results = (
    Result("figure 6.2", "GoToObject and GoToDropZone learned", "figure-6.2", base_skills,
           "1,000 generations", partial(spent, "figure-6.2", "GoToObject", "GoToDropZone"),
           ("base_skills",)),
    Result("figure 6.3", "Avoid learned", "figure-6.3", avoiding, "2,500 generations",
           partial(spent, "figure-6.3", "Avoid"), ("hierarchy", "longer_avoid")),
    Result("figure 6.4", "GoToObject+Avoid and GoToDropZone+Avoid learned", "figure-6.4",
           complex_skills, "1,500 generations each",
           partial(spent, "figure-6.4", "GoToObject+Avoid", "GoToDropZone+Avoid"), ("hierarchy",)),
    Result("figure 6.5", "Collect learned", "figure-6.5", collecting, "1,500 generations",
           partial(spent, "figure-6.5", "Collect"), ("hierarchy",)),
    Result("table 6.1", "hierarchy or monolith, curriculum or final task only", "table-6.1",
           structures, "1,000 generations a skill, 1,500 in figures 6.4 and 6.5; of the others it "
           "is not told",
           partial(spent_in, "table-6.1", ("hierarchical, curriculum", "monolithic, curriculum",
                   "hierarchical, final task only", "monolithic, final task only")),
           ("hierarchy", "monolith", "hierarchy_at_once", "monolith_at_once", "hierarchy_level",
            "monolith_level"), same_seeds, ("table-6.1-equal-ticks", "figure-6.5-equal-ticks")),
    Result("table 6.2", "more resources for Avoid, or Avoid learned in context", "table-6.2",
           retraining, "Avoid 1,000 or 2,500 generations, 1,500 in context",
           partial(spent_in, "table-6.2", ("Avoid as in the curriculum", "Avoid with more ticks",
                   "Avoid in context", "monolithic")),
           ("monolith", "hierarchy", "longer_avoid", "in_context")),
    Result("table 6.3", "power management: two variants on two Avoids", "table-6.3", power,
           "not told",
           partial(spent_in, "table-6.3", ("Retrained, original Avoid",
                   "Encapsulated, original Avoid", "Retrained, all skills in context",
                   "Encapsulated, all skills in context")),
           ("power_retrained_original", "power_encapsulated_original", "power_retrained",
            "power_encapsulated"), shared_draws),
)  # fmt: skip
