"""What a page says of the machine."""

import platform
import re
import subprocess


def output(*command):
    return subprocess.run(command, capture_output=True, text=True).stdout


def processor():
    found = re.search(r"Model name:\s*(.*)", output("lscpu"))
    return found.group(1).strip() if found else platform.processor()
