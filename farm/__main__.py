"""`python -m farm`: the same as the command `farm`."""

from farm.start import run_command

if __name__ == "__main__":
    run_command()
