"""`python -m studies.speed_accuracy`."""

from studies.speed_accuracy.run import main

if __name__ == "__main__":
    raise SystemExit(main())
