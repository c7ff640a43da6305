"""Manual pages and shell completion of what `antigrasp help` says: shell_files.py ANTIGRASP FOLDER writes share/man/man1/*.1 and
share/bash-completion/completions/antigrasp there. Run by `cmake --install`."""
import pathlib
import re
import subprocess
import sys

SECTIONS = ("Positionals:", "Options:", "Subcommands:")
LEFT = 30  # the help's column of descriptions


def help_text(program, command):
    return subprocess.run([program, "help", *command], check=True, capture_output=True, text=True).stdout


def parse(text):
    """{"about", "usage", section: [(left, description)]} of a help text."""
    found = {"about": "", "usage": "", **{section: [] for section in SECTIONS}}
    section, lines = None, text.splitlines()
    for line, after in zip(lines, [*lines[1:], ""]):
        if line in SECTIONS:
            section = line
        elif line.startswith("Usage: "):
            found["usage"] = line[7:]
        elif section is None:
            found["about"] = (found["about"] + " " + line.strip()).strip()
        elif line.startswith("  ") and not line.startswith("   "):
            end = len(line) if after.startswith(" " * LEFT) else LEFT  # what is too long has its description below
            found[section].append([line[:end].strip(), line[end:].strip()])
        elif line.strip() and found[section]:
            found[section][-1][1] = (found[section][-1][1] + " " + line.strip()).strip()
    return found


def commands(program):
    """{words of a command: its parsed help}, the program itself under ()."""
    known, waiting = {}, [()]
    while waiting:
        command = waiting.pop(0)
        known[command] = parse(help_text(program, command))
        if command != ("help",):
            waiting += [(*command, left) for left, _ in known[command]["Subcommands:"]]
    return known


def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text.startswith((".", "'")) else text


def manual(command, page, version):
    name = "-".join(("antigrasp", *command))
    lines = [f'.TH {name.upper()} 1 "" "antigrasp {version}" "User Commands"', ".SH NAME", f"{roff(name)} \\- {roff(page['about'])}", ".SH SYNOPSIS",
             roff(page["usage"])]
    for section in SECTIONS:
        if page[section]:
            lines.append(f".SH {section[:-1].upper() if section != 'Subcommands:' else 'COMMANDS'}")
        for left, right in page[section]:
            lines += [".TP", f"\\fB{roff(left)}\\fR", roff(right) or "\\&"]
    lines += [".SH EXIT STATUS", "0 done; 1 failed; 2 bad input, told in one line; 130 interrupted."]
    others = [f".BR {roff('-'.join(('antigrasp', *command[:-1])))} (1)"] if command else []
    others += [f".BR {roff('-'.join(('antigrasp', *command, left)))} (1)" for left, _ in page["Subcommands:"] if left != "help"]
    return "\n".join(lines + ([".SH SEE ALSO", *others] if others else [])) + "\n"


def flags(page):
    """(all flags, {flag: its choices})"""
    names, choices = [], {}
    for left, _ in page["Options:"]:
        head, _, rest = left.partition(" ")
        own = [re.sub(r"\{.*", "", name) for name in head.split(",")]  # --no-adaptive{false}
        names += own
        among = re.search(r"\{([^}]*)\}", rest)
        for name in own:
            if among:
                choices[name] = among.group(1).split(",")
    return names, choices


def completion(known):
    lines = ["# Completion of antigrasp for bash; made from its help (zsh: autoload bashcompinit && bashcompinit).", "_antigrasp() {",
             "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command= i",
             "  for ((i = 1; i < COMP_CWORD; ++i)); do", '    case "$command ${COMP_WORDS[i]}" in']
    paths = [" ".join(command) for command in known if command]
    lines += [f'      " {path}" | "{path}") command="{path}" ;;' if " " not in path else f'      "{path}") command="{path}" ;;' for path in paths]
    lines += ["    esac", "  done", "  COMPREPLY=()", '  case "$command:$before" in']
    for command, page in known.items():
        for flag, among in flags(page)[1].items():
            lines.append(f"    \"{' '.join(command)}:{flag}\") COMPREPLY=($(compgen -W '{' '.join(among)}' -- \"$word\")); return ;;")
    lines += ["  esac", '  local flags="" words=""', '  case "$command" in']
    for command, page in known.items():
        words = [left for left, _ in page["Subcommands:"]]
        if command == ("help",):
            words = [left for left, _ in known[()]["Subcommands:"]]
        lines.append(f"    \"{' '.join(command)}\") flags='{' '.join(flags(page)[0])}' words='{' '.join(words)}' ;;")
    lines += ["  esac", "  if [[ $word == -* ]]; then", '    COMPREPLY=($(compgen -W "$flags" -- "$word"))', "  elif [[ -n $words ]]; then",
              '    COMPREPLY=($(compgen -W "$words" -- "$word"))', "  else", '    COMPREPLY=($(compgen -f -- "$word"))', "  fi", "}",
              "complete -o filenames -F _antigrasp antigrasp"]
    return "\n".join(lines) + "\n"


def main(program, folder):
    known = commands(program)
    version = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout.split()[1]
    pages, completions = pathlib.Path(folder, "share/man/man1"), pathlib.Path(folder, "share/bash-completion/completions")
    for place in (pages, completions):
        place.mkdir(parents=True, exist_ok=True)
    for command, page in known.items():
        if command != ("help",):
            (pages / ("-".join(("antigrasp", *command)) + ".1")).write_text(manual(command, page, version))
    (completions / "antigrasp").write_text(completion(known))


if __name__ == "__main__":
    main(*sys.argv[1:])
