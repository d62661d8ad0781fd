"""The runs behind the pictures of the documentation, and how they are made or found; used by pictures.py."""
import pathlib
import subprocess

from run_frame import UserError

# Name of the run folder -> words after `acinus run`. Seconds to about two minutes of processor time each.
SHORT = {
    "adhering_pair": "adhering_pair",
    "aspiration": "aspiration",
    "clump13": "clump13",
    "lobule_cbm": "lobule_cbm",
    "lobule_hybrid": "lobule_hybrid",
    "lobule_start": "lobule_dcm --until \"1 s\"",
    "monolayer_type1": "monolayer_type1 --until-cells 100",
    "monolayer_type2": "monolayer_type2 --until-cells 100",
    "monolayer_type3": "monolayer_type3 --until-cells 100",
    "narrow_gap": "narrow_gap",
    "narrow_gap_nucleus": "narrow_gap_nucleus",
    "openvt_monolayer": "openvt_monolayer --until-cells 300",
    "optical_stretcher": "optical_stretcher",
    "patch_box": "patch_box",
    "plates": "plates",
    "pull_off": "pull_off",
    "regeneration": "regeneration --until \"1 d\"",
    "spheroid": "spheroid --until-cells 50",
    "spheroid_adhesive": "spheroid_adhesive --until-cells 80",
    "spheroid_cbm": "spheroid_cbm",
    "tear": "tear",
    "vessel_file": "vessel_file",
}
# Minutes to hours.
LONG = {
    "lobule_moving_zoom": "lobule_moving_zoom",
    "patch_capsule": "patch_capsule --until \"33 h\"",
    "pull_off_2562": "pull_off --set cell_types.suspended.dcm.nodes=2562",
    "spheroid_200": "spheroid --until-cells 200",
    "spheroid_adhesive_200": "spheroid_adhesive --until-cells 200",
    "spheroid_adhesive_1000": "spheroid_adhesive",
}


class Runs:
    """Run folders below one folder; a run that is missing is made with the program."""

    def __init__(self, folder, program, make_long):
        self.folder, self.program, self.make_long = pathlib.Path(folder), program, make_long

    def get(self, name):
        """The folder of a run that is complete, as text."""
        import json
        import shlex
        place = self.folder / f"{name}.run"
        summary = place / "summary.json"
        if summary.exists() and json.loads(summary.read_text())["status"] == "completed":
            return str(place)
        if name not in SHORT and not self.make_long:
            raise UserError(f"{place} is missing; it takes minutes to hours: --long makes it")
        words = shlex.split(SHORT.get(name) or LONG[name])
        print(f"runs {' '.join(words)}", flush=True)
        self.folder.mkdir(parents=True, exist_ok=True)
        command = [self.program, "run", *words, "--threads", "1", "--quiet", "--overwrite", "--out", str(place)]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise UserError(f"{shlex.join(command)}: exit code {done.returncode}: {done.stderr.strip()[-500:]}")
        return str(place)

    def cost(self, name):
        """Processor time in s and the numbers of deformable cells and spheres at the end."""
        import json
        summary = json.loads((pathlib.Path(self.get(name)) / "summary.json").read_text())
        return summary["cpu_s"], summary["cells"]["dcm"], summary["cells"]["cbm"]
