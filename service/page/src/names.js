// Names of quantities in plain words, and one unit for each.

const NAMES = {
  mean_pressure: "Mean contact pressure", lesion_area_relative: "Relative lesion area", lesion_radius_rings_centre: "Lesion radius, mean of the three inner rings of cells, by centres",
  lesion_radius_rings_surface: "Lesion radius, mean of the three inner rings of cells, by surfaces", lesion_radius: "Lesion radius",
  lesion_radius_slices_centre: "Lesion radius, mean over slices, by the nearest cell centre", lesion_radius_slices_surface: "Lesion radius, mean over slices, by the nearest cell surface",
  front_radius_mean: "Mean radius of the front", front_roughness: "Roughness of the front", radius_of_gyration: "Radius of gyration", gap: "Distance of the plates",
  pull_force: "Pulling force", pull_force_relative: "Relative pulling force", pull_off: "Pull-off force", ratio_to_piWR: "Pull-off force over π W R", force: "Force",
  shell_force: "Force on a thin shell", adhesion_energy: "Adhesion energy", radius: "Radius", interface_force: "Forces between deformable cells and spheres",
  interface_pairs: "Pairs of a deformable cell and a sphere in contact", cells_dcm: "Deformable cells", cells_cbm: "Spheres",
};
const UNITS = /_(um2?|um3|nN|Pa|kPa|s|d|h|um_per_h|um_h|mN_m|J_m2|per_mm3|per_cell_um2)$/;
const UNIT_OF = { um: "µm", um2: "µm²", um3: "µm³", nN: "nN", Pa: "Pa", kPa: "kPa", s: "s", d: "d", h: "h", um_per_h: "µm/h", um_h: "µm/h", mN_m: "mN/m", J_m2: "J/m²", per_mm3: "1/mm³", per_cell_um2: "µm²" };
const MODELS = { dcm: "deformable cells", cbm: "spheres" };
const SIZES = { mean: "Mean", max: "Largest", min: "Smallest" };

const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

// "contact_pressure_mean_dcm_Pa": "Mean contact pressure of deformable cells"
export function nameOf(observable) {
  const bare = observable.replace(UNITS, "");
  if (NAMES[bare]) return NAMES[bare];
  const words = bare.split("_");
  const size = words.find((w) => SIZES[w]), model = words.find((w) => MODELS[w]);
  const rest = words.filter((w) => w !== size && w !== model).join(" ");
  return capital(`${size ? `${SIZES[size]} ` : ""}${rest}${model ? ` of ${MODELS[model]}` : ""}`);
}

// Unit that the name of a single result ends with.
export const unitOfName = (name) => UNIT_OF[name.match(UNITS)?.[1]] ?? "";

// Pressures are in Pa everywhere: [factor, unit].
export const shownIn = (unit) => (unit === "kPa" ? [1000, "Pa"] : [1, unit ?? ""]);

// A curve in the unit that is shown.
export function inShownUnit(curve) {
  const [factor] = shownIn(curve.unit);
  return factor === 1 ? curve : { ...curve, value: curve.value.map((v) => (v == null ? null : factor * v)) };
}
