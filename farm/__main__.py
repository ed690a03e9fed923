"""`python -m farm`: the same as the command `farm`."""

from farm.start import prepare

if __name__ == "__main__":
    prepare()
    from farm.cli import main

    main()
