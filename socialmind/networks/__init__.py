"""Networks: links between agents, with fields, births and deaths of their own."""
