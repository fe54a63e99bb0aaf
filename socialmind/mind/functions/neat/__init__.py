"""Networks whose topology evolves, as neat-python has them (thesis, A.3.1)."""
