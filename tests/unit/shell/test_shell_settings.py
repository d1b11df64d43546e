"""Settings of the analysis reach the material and the options that the shell works with."""

import pytest

from foldshell.settings.make import make_settings
from foldshell.settings.stage import read_stage
from foldshell.settings.stages import STAGES, stage_parameters


def test_creep_divides_the_modulus_of_every_stage():
    settings = make_settings({"analysis": {"creep_coefficient": 1.0}})
    assert settings.material.youngs_modulus == pytest.approx(31e6 / 2)
    plain = stage_parameters(settings, "analyse")
    assert plain["material"]["youngs_modulus"] == pytest.approx(31e6 / 2)


def test_imperfection_reaches_the_analysis_in_metres_and_is_none_by_default():
    asked = make_settings({"analysis": {"imperfection_mm": 20}})
    plain = stage_parameters(asked, "analyse")
    options = read_stage(plain, *STAGES["analyse"]).analysis
    assert options.imperfection == pytest.approx(0.02)
    assert make_settings({}).analysis.imperfection == 0.0
