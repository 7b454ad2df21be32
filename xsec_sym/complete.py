"""What a shell completes: ids, names and sources, from the record's data alone, and the script that asks for them."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import click
from click.shell_completion import (
    BashComplete,
    CompletionItem,
    FishComplete,
    add_completion_class,
    get_completion_class,
)

Items = list[CompletionItem]


class Bash(BashComplete):
    """Bash takes a colon for the end of a word, and would complete deon2016:1 to deon2016:deon2016:18: so the line is
    split here, and what stands before the last colon is not said again."""

    source_template = r"""%(complete_func)s() {
    local line=${COMP_LINE:0:COMP_POINT} kind value IFS=$'\n'
    local word=${line##*[[:space:]]} said=
    [[ $COMP_WORDBREAKS == *:* && $word == *:* ]] && said=${word%%:*}:
    COMPREPLY=()
    while IFS=, read -r kind value; do
        case $kind in
            file) compopt -o default ;;
            dir) compopt -o dirnames ;;
            plain) COMPREPLY+=("${value#"$said"}") ;;
        esac
    done < <(COMP_WORDS=$line %(complete_var)s=bash_complete "$1" 2>/dev/null)
}
complete -o nosort -F %(complete_func)s %(prog_name)s
"""

    def get_completion_args(self) -> tuple[list[str], str]:
        from click.shell_completion import split_arg_string

        line = os.environ["COMP_WORDS"]
        words = split_arg_string(line)
        last = words.pop() if words and not line[-1:].isspace() else ""
        return words[1:], last


class Fish(FishComplete):
    """What is said of a word may hold commas, and what comes stays in the order of the sources."""

    source_template = r"""function %(complete_func)s
    set -lx %(complete_var)s fish_complete
    set -lx COMP_WORDS (commandline -cp)
    set -lx COMP_CWORD (commandline -t)
    for line in (%(prog_name)s 2>/dev/null)
        set -l said (string split --max 1 , -- $line)
        switch $said[1]
            case dir
                __fish_complete_directories $said[2]
            case file
                __fish_complete_path $said[2]
            case plain
                echo $said[2]
        end
    end
end
complete --no-files --keep-order --command %(prog_name)s --arguments "(%(complete_func)s)"
"""


def register() -> None:
    add_completion_class(Bash)
    add_completion_class(Fish)


def script(shell: str, program: click.Command, variable: str) -> str:
    """What a shell reads to switch completion on."""
    register()
    found = get_completion_class(shell)
    assert found is not None
    made = found(program, {}, "xsec", variable)
    return made.source_template % made.source_vars()


# --- what there is -----------------------------------------------------------------------------------------


def _record(context: click.Context) -> Mapping[str, Any]:
    from xsec_sym.record import store

    own = context.params.get("derivations")
    found = store.Ledger(store.DATA, *([os.path.join(own, "record")] if own else []))
    try:
        len(found)
    except store.BrokenRecord:
        return {}
    return found


def _items(known: Iterable[tuple[str, str]], word: str) -> Items:
    return [CompletionItem(name, help=said) for name, said in known if name.startswith(word)]


def _sources(record: Mapping[str, Any]) -> list[tuple[str, str]]:
    from xsec_sym.record.sources import SOURCES

    keys = dict.fromkeys(e.source for e in record.values())
    return [(key, (SOURCES[key].about or SOURCES[key].title) if key in SOURCES else "") for key in keys]


def sources(context: click.Context, word: str) -> Items:
    return _items(_sources(_record(context)), word)


def ids(context: click.Context, word: str) -> Items:
    return _items(((e.id, f"{e.verdict}: {e.title}") for e in _record(context).values()), word)


def ids_and_sources(context: click.Context, word: str) -> Items:
    return sources(context, word) + ids(context, word)


def exports(context: click.Context, word: str) -> Items:
    """The names of functions, the entries that these rest on, and those of which the report keeps code.

    Which of the second kind can be written alone is not known without SymPy; a refusal names the function to take.
    """
    from xsec_sym.export.recipes import RECIPES

    record = _record(context)
    behind = [name for r in RECIPES.values() for name in (*r.ids, r.cell)]
    coded = [name for name, stored in code().items() if "text" in stored]
    forms = [record[name] for name in dict.fromkeys([*behind, *coded]) if name in record]
    return _items([(r.name, r.summary) for r in RECIPES.values()] + [(e.id, e.title) for e in forms], word)


@cache
def code() -> dict[str, Any]:
    """The code that the report keeps, by the ids of entries."""
    # by its path: the package imports what draws pages
    path = Path(__file__).parent / "report" / "data" / "code.json"
    found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    return found


def quantities(context: click.Context, word: str) -> Items:
    from xsec_sym.study.method import HOMES

    return _items(((name, "") for name in HOMES), word)


def folders(context: click.Context, word: str) -> Items:
    return [CompletionItem(word, type="dir")]
