"""Looks up every pinned package in the databases of known vulnerabilities; used by `make audit`.

pip-audit calls packages that its service does not know "not audited", and ends well even if that is all of them. Here
that counts as no answer. Exit codes: 0 nothing known, 1 vulnerabilities found, 2 could not be told.
"""

import argparse
import json
import subprocess
import sys
from pathlib import Path

_ROOT = Path(__file__).parents[1]
_PATIENCE_S = 300


def main(arguments: list[str]) -> int:
    """Audit a file of pins; returns the exit code."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("pins", nargs="?", type=Path, default=_ROOT / "constraints.txt")
    pins = parser.parse_args(arguments).pins
    reasons = []
    for service in ("pypi", "osv"):
        found = _ask(service, pins)
        if isinstance(found, str):
            reasons.append(f"{service}: {found}")
            continue
        for line in found:
            print(line)
        print(f"{len(found)} known vulnerabilities, by {service}")
        return 1 if found else 0
    print(f"audit: NOT DONE, nothing can be said of {pins.name}: {'; '.join(reasons)}", file=sys.stderr)
    return 2


def _ask(service: str, pins: Path) -> list[str] | str:
    """A line for each vulnerability; or why the service could not tell of every package."""
    command = [sys.executable, "-m", "pip_audit", "--vulnerability-service", service, "--requirement", str(pins)]
    command += ["--no-deps", "--disable-pip", "--format", "json", "--progress-spinner", "off"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=_PATIENCE_S)  # noqa: S603 - our own program and arguments
        packages = json.loads(done.stdout)["dependencies"]
    except subprocess.TimeoutExpired:
        return f"no answer within {_PATIENCE_S} s"
    except (ValueError, KeyError, TypeError):
        last = (done.stderr.strip().splitlines() or ["no output"])[-1]
        return f"pip-audit failed: {last[:200]}"
    if not packages:
        return "no package to audit"
    skipped = [package["name"] for package in packages if "skip_reason" in package]
    if skipped:
        return f"{len(skipped)} of {len(packages)} packages are unknown to it, {skipped[0]} first"
    return [
        f"{package['name']} {package['version']}: {fault['id']}, mended in {', '.join(fault['fix_versions']) or 'none'}"
        for package in packages
        for fault in package["vulns"]
    ]


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
