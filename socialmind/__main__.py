"""What `socialmind` starts, and `python -m socialmind`."""

import sys


def main() -> None:
    """Entry point of the console script; Ctrl-C while it is being read ends it quietly, too."""
    try:
        from socialmind.cli import main as command_line

        command_line()
    except KeyboardInterrupt:
        sys.exit(130)


if __name__ == "__main__":
    main()
