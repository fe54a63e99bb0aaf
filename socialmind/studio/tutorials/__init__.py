"""The first hour in the studio: tutorials of steps beside an editor, each step checked."""
