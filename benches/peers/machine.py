"""What a page says of the machine, and what keeps it for a program."""

import os
import platform
import re
import subprocess


def output(*command):
    return subprocess.run(command, capture_output=True, text=True).stdout


def processor():
    found = re.search(r"Model name:\s*(.*)", output("lscpu"))
    return found.group(1).strip() if found else platform.processor()


def undisturbed():
    """What to put in front of a program: one core, ahead of everything else, where that is allowed and wanted."""
    prefix = ["chrt", "-f", "10", "taskset", "-c", str(max(os.sched_getaffinity(0)))]
    if os.environ.get("PEERS_PRIORITY") == "0":
        return []
    try:
        allowed = subprocess.run([*prefix, "true"], capture_output=True).returncode == 0
    except FileNotFoundError:
        allowed = False
    return prefix if allowed else []
