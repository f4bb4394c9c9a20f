"""Judging recordings."""

import pytest

import trackdyn as td


def test_a_good_drive_is_good_for_all(drive, robot, tmp_path):
    drive.write(tmp_path / "drive")
    found = td.inspect(tmp_path / "drive", vehicle=robot)
    assert found.content == "motion" and found.driving["runs"] == 3
    assert {use: verdict for use, (verdict, _) in found.readiness.items()} == {
        "identify": "yes",
        "odometry": "yes",
        "diagnose": "yes",
    }
    gap, low, high = found.driving["separation"]
    assert low < gap < high and gap == pytest.approx(0.833, abs=0.02)
    assert found.figure.to_png().startswith(b"\x89PNG")
    fit, judge = (td.read_recording(tmp_path / "drive").part(*part) for part in found.parts)
    assert (fit.runs, judge.runs) == ([0, 1], [2])
    assert "identify" in found._repr_html_()


def test_what_a_drive_lacks_is_told(robot, tmp_path):
    straight = [[0.0, 0.5, 0.5], [10.0, 0.0, 0.0]]
    td.simulate(robot, straight).write(tmp_path / "drive")
    found = td.inspect(tmp_path / "drive")
    assert found.readiness["identify"][0] == "no" and found.readiness["identify"][1]
    assert any("turning" in what and advice for what, advice in found.lacks)


def test_options_go_on_to_reading(drive, tmp_path):
    """Track speeds in km/h: what reads them is among the options."""
    drive.write(tmp_path / "drive")
    lines = (tmp_path / "drive" / "tracks.csv").read_text().splitlines()
    head = lines[0].split(",")
    places = [head.index("v_left"), head.index("v_right")]

    def faster(line):
        cells = line.split(",")
        for place in places:
            cells[place] = repr(3.6 * float(cells[place]))
        return ",".join(cells)

    text = "\n".join([lines[0], *map(faster, lines[1:])]) + "\n"
    (tmp_path / "drive" / "tracks.csv").write_text(text)
    found = td.inspect(tmp_path / "drive", speed_unit="km/h")
    assert found.options == {"speed_unit": "km/h"}
    read = td.read_recording(tmp_path / "drive", **found.options)
    assert abs(read.tracks["v_left"]).max() <= 1.01
    with pytest.raises(td.RecordingError, match="km/h"):
        td.read_recording(tmp_path / "drive")
