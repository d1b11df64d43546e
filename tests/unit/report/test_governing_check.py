"""Which check governs, and how its share is said."""

from foldshell.report.checks import Check, describe_share, find_governing


def test_a_check_that_is_open_does_not_hide_one_that_fails():
    """Shear beside folds does not settle with the mesh; stability does, and is above its limit."""
    shear = Check("shear (open: does not settle)", 99.0, 1.0, 99.0, False)
    stability = Check("stability", 2.0, 6.0, 3.0, False)
    fine = Check("displacement", 1.0, 2.0, 0.5, True)
    assert find_governing([shear, stability, fine]) is stability
    assert find_governing([shear, fine]) is shear
    assert describe_share(99.0) == "99 times or more"
    assert describe_share(98.9999999995) == "99 times or more"  # as files have it: a quotient
