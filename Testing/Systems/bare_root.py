# SPDX-License-Identifier: BSD-3-Clause
"""A root of Debian that has nothing else, made by debootstrap: for what is to work on a system as it comes."""
import contextlib
import glob
import os
import pathlib
import re
import shutil
import subprocess

SOURCES = ("/etc/apt/sources.list", "/etc/apt/sources.list.d/*.sources", "/etc/apt/sources.list.d/*.list")
MOUNTS = {
    "proc": ["-t", "proc", "proc"],
    "sys": ["-t", "sysfs", "-o", "ro", "sysfs"],
    "dev": ["--bind", "/dev"],
    "dev/shm": ["-t", "tmpfs", "tmpfs"],
}


def codename():
    """Of this system: bookworm, trixie; empty where there is none."""
    with open("/etc/os-release", encoding="utf-8") as file:
        return dict(re.findall(r'^(\w+)="?([^"\n]*)', file.read(), re.M)).get("VERSION_CODENAME", "")


def archives():
    """The archives of Debian that this machine takes its packages from, as lines of a sources.list without `deb`: (address, suite,
    components)."""
    found = []
    for path in (path for pattern in SOURCES for path in sorted(glob.glob(pattern))):
        text = re.sub(r"^\s*#.*\n", "", pathlib.Path(path).read_text(encoding="utf-8"), flags=re.M)
        found += re.findall(r"^deb\s+(?:\[.*?\]\s*)?(\S+)\s+(\S+)\s+(.+)$", text, re.M)
        for entry in re.split(r"\n\s*\n", text):
            fields = dict(re.findall(r"^(\w[\w-]*):\s*(.*)$", entry, re.M))
            if "deb" in fields.get("Types", "").split():
                found += [(address, suite, fields.get("Components", "")) for address in fields.get("URIs", "").split()
                          for suite in fields.get("Suites", "").split()]
    return [entry for entry in found if re.fullmatch(rf"{codename()}(-updates|-security)?", entry[1])]


def lack():
    """Why there can be no bare root here; empty when there can."""
    if os.geteuid() != 0:
        return "this is not root"
    if shutil.which("debootstrap") is None:
        return "debootstrap is not there (package debootstrap)"
    if not archives():
        return "no list of sources names an archive of Debian"
    return ""


class BareRoot:
    """Of a suite (bookworm, trixie) in a folder; one that is there already is taken as it is. Used by `with`: what is mounted in it is
    taken away at the end, come what may."""

    def __init__(self, folder, suite):
        self.folder, self.suite = pathlib.Path(folder).resolve(), suite
        self.mounted = contextlib.ExitStack()

    def __enter__(self):
        here, lists = codename(), archives()
        if not (self.folder / "etc/debian_version").exists():
            self.folder.mkdir(parents=True, exist_ok=True)
            mirror = next(address for address, suite, _ in lists if suite == here)
            subprocess.run(["debootstrap", "--variant=minbase", self.suite, str(self.folder), mirror], check=True,
                           stdout=subprocess.DEVNULL)
        for path in ["/etc/resolv.conf", "/etc/hosts", *glob.glob("/etc/apt/apt.conf.d/*")]:
            shutil.copy(path, str(self.folder) + path)
        (self.folder / "etc/apt/sources.list").write_text(
            "".join(f"deb {address} {suite.replace(here, self.suite)} {components}\n" for address, suite, components in lists),
            encoding="utf-8")
        with contextlib.ExitStack() as mounted:
            for place, options in MOUNTS.items():
                subprocess.run(["mount", *options, str(self.folder / place)], check=True)
                mounted.callback(subprocess.run, ["umount", "--lazy", str(self.folder / place)], check=True)
            self.mounted = mounted.pop_all()
        return self

    def __exit__(self, *_):
        self.mounted.close()

    def run(self, command, log=None, **variables):
        """Exit status and text of a shell's command in the root, with an environment of its own; log: a file that gets the text
        instead."""
        environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "LC_ALL": "C.UTF-8", "DEBIAN_FRONTEND": "noninteractive",
                       **variables}
        done = subprocess.run(["chroot", str(self.folder), "sh", "-c", command], text=True, check=False, env=environment,
                              stdin=subprocess.DEVNULL, stdout=log or subprocess.PIPE, stderr=subprocess.STDOUT)
        return done.returncode, done.stdout or ""

    def remove(self):
        """Removes the folder; after `with`, when nothing is mounted in it any more."""
        subprocess.run(["rm", "-rf", "--one-file-system", str(self.folder)], check=True)
