"""The help of all commands, as the page docs/reference/commands.md has it on the site."""

import re

import typer

MARK = "<!-- the help of all commands -->"


def on_page_markdown(markdown, page, config, files):
    """Put the help of all commands in the place of the mark.

    Args:
        markdown: A page's text.
        page: The page.
        config: The configuration of the site.
        files: The files of the site.

    Returns:
        The text, with the commands where it has the mark.
    """
    return markdown.replace(MARK, help_of_all()) if MARK in markdown else None


def help_of_all():
    """Return a section for each command: what it does, its arguments and its options."""
    from socialmind.cli import app

    group = typer.main.get_command(app)
    context = group.make_context("socialmind", [], resilient_parsing=True)
    return "\n\n".join(help_of(name, group.get_command(context, name)) for name in group.commands)


def help_of(name, command):
    """Return the section of one command.

    Args:
        name: The command's name.
        command: The command, as Click has it.

    Returns:
        Markdown.
    """
    lines = [f"## socialmind {name}", "", said(command.help), "", "| | |", "|---|---|"]
    for one in command.params:
        words = one.opts if one.param_type_name == "option" else ()
        shown = " ".join(filter(None, [", ".join(words), one.metavar])) or one.name.upper()
        lines.append(f"| `{shown}` | {said(one.help)} |".replace("`|", "`\\|"))
    return "\n".join(lines)


def said(text):
    """Return a help text in one line, as Markdown has it."""
    return re.sub(r"\s+", " ", text or "").strip().replace("|", "\\|").replace("<", "&lt;")
