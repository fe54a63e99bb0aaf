"""How a society begins: what its class shares, who and what is there at the start."""
