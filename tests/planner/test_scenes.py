"""Scenes that cannot be planned for: one line that names the file and the key, exit code 2, and no file."""

import pytest
from click.testing import CliRunner

from xsec_sym import cli, plan
from xsec_sym.planner import BadScene, Scene, Unmet

GOOD = """
[scene]
name = "harbour"
tolerance = 1e-3

[[material]]
name = "fog"
quantity = "sigma_spherical_gaussian"
alpha = 2.0
"""

BAD = {
    "unknown quantity": (("sigma_spherical_gaussian", "sigma_sperical_gaussian"), "quantity", "did you mean"),
    "quantity no name": (('"sigma_spherical_gaussian"', "3"), "quantity", "3"),
    "upside down": (("2.0", "[2.0, 1.0]"), "alpha", "upside down"),
    "out of domain": (("2.0", "[2.0, 1e9]"), "alpha", "outside"),
    "constant out of domain": (("2.0", "-1"), "alpha", "outside"),
    "cosine out of domain": (("alpha = 2.0", "alpha = 2.0\nu = [-1.5, 1]"), "u", "outside"),
    "no range": (("2.0", "[1, 2, 3]"), "alpha", "no range"),
    "missing roughness": (("alpha = 2.0", ""), "alpha", "missing"),
    "missing quantity": (('quantity = "sigma_spherical_gaussian"', ""), "quantity", "missing"),
    "missing name": (('name = "fog"', ""), "name", "missing"),
    "missing tolerance": (("tolerance = 1e-3", ""), "tolerance", "missing"),
    "no TOML": (("alpha = 2.0", "alpha = = 2.0"), "line 9", ""),
    "negative tolerance": (("1e-3", "-1e-3"), "tolerance", "-0.001"),
    "zero tolerance": (("1e-3", "0"), "tolerance", "0"),
    "tolerance NaN": (("1e-3", "nan"), "tolerance", "NaN"),
    "tolerance infinite": (("1e-3", "inf"), "tolerance", "inf"),
    "tolerance a word": (("1e-3", '"small"'), "tolerance", "small"),
    "tolerance true": (("1e-3", "true"), "tolerance", "True"),
    "roughness NaN": (("2.0", "nan"), "alpha", "NaN"),
    "range with NaN": (("2.0", "[nan, 1]"), "alpha", "NaN"),
    "range of words": (("2.0", '["a", "b"]'), "alpha", "'a'"),
    "unknown key": (("alpha = 2.0", "alpha = 2.0\nroughness = 1"), "roughness", "no key"),
    "unknown table": (("[scene]", "[scenery]"), "scenery", "did you mean scene"),
    "unknown key of the scene": (('name = "harbour"', "tolerence = 1"), "tolerence", "did you mean tolerance"),
    "error of another kind": (("tolerance = 1e-3", 'tolerance = 1e-3\nerror = "ulp"'), "error", "ulp"),
    "another type": (("tolerance = 1e-3", 'tolerance = 1e-3\ndtype = "half"'), "dtype", "half"),
    "no evaluations": (("alpha = 2.0", "alpha = 2.0\nevaluations = 0"), "evaluations", "0"),
    "half an evaluation": (("alpha = 2.0", "alpha = 2.0\nevaluations = 0.5"), "evaluations", "0.5"),
    "a name of nothing": (('name = "fog"', 'name = "!?"'), "name", "!?"),
    "a name of two lines": (('name = "fog"', 'name = "a\\nb"'), "name", "one line"),
    "one bracket": (("[[material]]", "[material]"), "material", "[[material]]"),
    "no material": ((GOOD[GOOD.index("[[") :], ""), "material", "none"),
    "two of a name": (
        ("[[material]]", GOOD[GOOD.index("[[") :].replace('"fog"', '"FOG"') + "[[material]]"),
        "name",
        "fog",
    ),
}


def run(path, *options):
    return CliRunner().invoke(cli.main, ["plan", str(path), *map(str, options)])


def complaint(result):
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    lines = result.stderr.splitlines()
    assert len(lines) == 1
    return lines[0]


@pytest.mark.parametrize("case", BAD)
def test_bad_scenes_get_one_line_and_no_file(tmp_path, case):
    (before, after), key, more = BAD[case]
    assert before in GOOD
    scene = tmp_path / "scene.toml"
    scene.write_text(GOOD.replace(before, after, 1), encoding="utf-8")
    said = complaint(run(scene, "-o", tmp_path / "kernels.py", "--json", tmp_path / "plan.json"))
    assert "scene.toml" in said and key in said and more in said
    assert [p.name for p in tmp_path.iterdir()] == ["scene.toml"]


def test_a_scene_that_is_not_there_and_one_that_is_no_text(tmp_path):
    assert "none.toml" in complaint(run(tmp_path / "none.toml"))
    (tmp_path / "bytes.toml").write_bytes(b"\xff\xfe")
    assert "bytes.toml" in complaint(run(tmp_path / "bytes.toml"))
    assert str(tmp_path) in complaint(run(tmp_path))


def test_a_folder_is_no_module(tmp_path):
    (tmp_path / "scene.toml").write_text(GOOD, encoding="utf-8")
    assert "cannot write" in complaint(run(tmp_path / "scene.toml", "-o", tmp_path))


def test_a_tolerance_that_nothing_meets_names_the_best(tmp_path):
    scene = tmp_path / "scene.toml"
    scene.write_text(GOOD.replace("1e-3", "1e-20"), encoding="utf-8")
    said = complaint(run(scene, "-o", tmp_path / "kernels.py"))
    assert "fog" in said and "tolerance" in said and "the best is" in said
    assert not (tmp_path / "kernels.py").exists()
    with pytest.raises(Unmet):
        plan(
            {
                "material": [
                    dict(name="a", quantity="sigma_spherical_gaussian", alpha=1, tolerance=1e-9, dtype="float32")
                ]
            }
        )


def test_dictionaries_are_scenes_too():
    row = dict(name="a", quantity="sigma_spherical_gaussian", alpha=[1, 2], tolerance=1e-3)
    (material,) = Scene.of({"material": [row]}).materials
    assert material.arguments == ["u", "alpha"] and material.spans == {"u": (-1.0, 1.0), "alpha": (1.0, 2.0)}
    assert material.error == "relative" and material.dtype == "float64"
    with pytest.raises(BadScene, match=r"scene: material 1 \(a\): alpha"):
        Scene.of({"material": [row | {"alpha": 10**400}]})
    with pytest.raises(BadScene, match="no table"):
        Scene.of({"material": [3]})
