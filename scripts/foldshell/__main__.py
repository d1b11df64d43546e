"""`python -m foldshell` is the command `foldshell`."""

import sys

from foldshell.command import main

sys.exit(main())
