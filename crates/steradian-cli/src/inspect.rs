//! `steradian inspect`: what a scene, mesh, luminaire or measured surface holds, with its totals, and what is wrong with it, before anything is simulated.

mod contents;
mod findings;
mod json;
mod luminaire;
mod measured;
mod polar;
mod triangles;
mod ugr;

use std::path::{Path, PathBuf};

use clap::Args;
use steradian::quantity::Length;
use steradian::scene::Scene;
use steradian::transport::unsampled_by_any;
use steradian_io::files::DiskFiles;
use steradian_io::import::bsdf::is_measured;
use steradian_io::import::photometry;

use crate::load::Loaded;
use crate::status::{Failure, Outcome};
use crate::{
    load,
    output::{self, Format},
};
use contents::plural;
use findings::Finding;
use triangles::Triangles;

/// What a scene, mesh, luminaire or measured surface holds: shapes with areas, materials, lights with their flux, sensors, and what is wrong
///
/// Nothing is simulated. All triangles of the scene together are examined as one surface, in which vertices at the same place
/// are one. Told are edges that one triangle alone has, as light leaks there (not those of sheets, which lie in a plane and
/// are open by nature); edges of three triangles or more; edges along which one triangle shows its back; triangles that are
/// there twice; and triangles without area. A light is told to be unseen only if a closed opaque shape has it on one side
/// and all sensors on the other; other lights may be hidden, too. Light that no estimator can follow, such as that of a
/// point lamp seen in a mirror, is listed as not sampled.
///
/// Of a measured surface: header, blocks, the shares of the light that it reflects and transmits (means over the azimuths, and the
/// largest sum), by how much it is not reciprocal, and what was mended or passed over. Above is the side of the normal, the
/// interior; WINDOW calls light from there "Back".
///
/// Of a luminaire (IES LM-63, EULUMDAT, IES TM-33): header, flux by exact integration of the table as it is interpolated, light output ratio,
/// efficacy, greatest intensity, beam angle (half of the greatest intensity of a plane) and field angle (a tenth), CIE flux code,
/// luminous opening, and the UGR table: glare in rooms of X across and Y along the line of sight, over the height H of the luminaires above the eye, by CIE
/// 117 and CIE 190. An entry "-" has no luminaire that shines towards the observer.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// Scene file (TOML), or a file of another program (glTF, OBJ, PLY, STL; BSDF XML, MERL .binary, RGL .bsdf; IES, LDT, TM-33 XML)
    scene: PathBuf,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    /// Take vertices at most this far apart as one: 1mm, 0.1 mm …
    #[arg(long, value_name = "LENGTH", default_value = "0 m")]
    weld: Length,
    /// End with status 1 if anything is found or not sampled
    #[arg(long)]
    strict: bool,
    /// Draw the intensity of a luminaire in the planes C0-C180 and C90-C270, the one of C0 and C90 to the right
    #[arg(long, value_name = "FILE.svg|FILE.png")]
    plot: Option<PathBuf>,
}

const EXAMPLES: &str = "\
Examples:
  steradian inspect scenes/cornell-box.toml
  steradian inspect model.obj --weld 0.1mm --strict
  steradian inspect scenes/lamps-equal.toml --format json
  steradian inspect blinds.xml --strict
  steradian inspect downlight.ies
  steradian inspect pendant.ldt --plot pendant.svg";

/// What is known of a scene beyond the scene itself.
struct Inspection<'a> {
    scene: &'a Scene,
    hash: &'a str,
    triangles: Triangles,
    findings: Vec<Finding>,
    /// Edges of sheets, which are no finding.
    sheet_edges: usize,
    pieces: u32,
    unsampled: Vec<String>,
}

/// XML is a luminaire's only if it says so.
fn is_luminaire(path: &Path) -> bool {
    let is_xml = path
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("xml"));
    photometry::is_luminaire(path) && (!is_xml || photometry::is_tm33(path, &DiskFiles::default()))
}

/// Prints the lists.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let plot = arguments.plot.as_deref();
    if is_luminaire(&arguments.scene) {
        return luminaire::run(&arguments.scene, arguments.format, arguments.strict, plot);
    }
    if plot.is_some() {
        return Err(Failure::message(
            "--plot draws luminaires (IES, LDT, TM-33)",
        ));
    }
    if is_measured(&arguments.scene) {
        return measured::run(&arguments.scene, arguments.format, arguments.strict);
    }
    let loaded = load::scene(&arguments.scene)?;
    let inspection = Inspection::new(&loaded, arguments.weld);
    output::print(&match arguments.format {
        Format::Table => inspection.table(),
        Format::Json => format!("{:#}\n", inspection.json(&arguments.scene)),
    })?;
    let sound = inspection.findings.is_empty() && inspection.unsampled.is_empty();
    Ok(Outcome::fine_if(sound || !arguments.strict))
}

impl<'a> Inspection<'a> {
    fn new(loaded: &'a Loaded, weld: Length) -> Self {
        let scene = &loaded.scene;
        let triangles = Triangles::of(scene);
        let health = triangles.examine(weld);
        Self {
            scene,
            hash: &loaded.hash,
            findings: findings::of(scene, &triangles, &health),
            sheet_edges: health.boundary.iter().filter(|edge| edge.flat).count(),
            pieces: health.pieces,
            triangles,
            unsampled: unsampled_by_any(scene),
        }
    }

    fn table(&self) -> String {
        let missing = self
            .unsampled
            .iter()
            .map(|class| format!("Not sampled: {class}\n"));
        let warnings = self.scene.warnings().iter();
        let warnings = warnings.map(|warning| format!("Warning: {warning}\n"));
        let mut sections = vec![
            self.heading(),
            contents::shapes(self.scene).to_string(),
            contents::materials(self.scene).to_string(),
            contents::lights(self.scene).to_string(),
            contents::sensors(self.scene).to_string(),
            findings::list(&self.findings),
            missing.chain(warnings).collect(),
        ];
        sections.retain(|section| !section.is_empty());
        sections.join("\n")
    }

    fn heading(&self) -> String {
        let scene = self.scene;
        format!(
            "{}\nlanes: {}; K = {}; scene {}\n{}{}",
            scene.name(),
            scene.lanes().names().join(", "),
            scene.luminous_efficacy(),
            self.hash.get(..16).unwrap_or(self.hash),
            contents::extent(scene),
            self.surface(),
        )
    }

    /// One line about the triangles.
    fn surface(&self) -> String {
        let (count, pieces) = (self.triangles.count(), self.pieces);
        if count == 0 {
            return String::new();
        }
        let sheets = match self.sheet_edges {
            0 => String::new(),
            edges => format!("; sheets have {} free", plural(edges, "edge")),
        };
        let (count, pieces) = (plural(count, "triangle"), plural(pieces as usize, "piece"));
        format!("{count} in {pieces}{sheets}\n")
    }
}
