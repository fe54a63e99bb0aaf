"""What a stage can be told, by theme: each command is a function of the stage."""
