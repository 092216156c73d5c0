use super::*;
use steradian::brdf::measured::{Block, Side};
use steradian::geometry::{Direction, Vector};

use crate::import::bsdf::two_sided;

const BASES: &str = "<AngleBasis><AngleBasisName>two</AngleBasisName>\
<AngleBasisBlock><Theta>15</Theta><nPhis>1</nPhis><ThetaBounds><LowerTheta>0</LowerTheta><UpperTheta>30</UpperTheta></ThetaBounds></AngleBasisBlock>\
<AngleBasisBlock><Theta>60</Theta><nPhis>2</nPhis><ThetaBounds><LowerTheta>30</LowerTheta><UpperTheta>90</UpperTheta></ThetaBounds></AngleBasisBlock>\
</AngleBasis>";

fn block(direction: &str, data: &str) -> String {
    format!(
        "<WavelengthData><Wavelength unit=\"Integral\">Visible</Wavelength><WavelengthDataBlock>\
         <WavelengthDataDirection>{direction}</WavelengthDataDirection>\
         <ColumnAngleBasis>two</ColumnAngleBasis><RowAngleBasis>two</RowAngleBasis>\
         <AngleBasis>LBNL/Shirley-Chiu</AngleBasis>\n<ScatteringData>{data}</ScatteringData>\
         </WavelengthDataBlock></WavelengthData>"
    )
}

fn document(structure: &str, blocks: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<WindowElement><FileType>BSDF</FileType><Optical><Layer>\
         <Material><Name>blind</Name><Thickness unit=\"Meter\">0.01</Thickness></Material><DataDefinition>\
         <IncidentDataStructure>{structure}</IncidentDataStructure>{BASES}</DataDefinition>{blocks}\
         </Layer></Optical></WindowElement>"
    )
}

fn read_text(text: &str) -> Result<MeasuredFile, BsdfError> {
    read(text.as_bytes())
}

fn message(text: &str) -> String {
    match read_text(text) {
        Ok(_) => "no fault".to_owned(),
        Err(error) => error.to_string(),
    }
}

const COUNTING: &str = "1 2 3, 4,5 6\t7\n8 9,";

fn value(structure: &str, [scattered, incident]: [usize; 2]) -> f64 {
    let text = document(structure, &block("Reflection Back", COUNTING));
    let file = read_text(&text).unwrap();
    let table = two_sided(file.model().unwrap()).unwrap();
    match table.reflection(Side::Above) {
        Some(Block::Matrix(matrix)) => matrix.at(scattered, incident),
        _ => f64::NAN,
    }
}

#[test]
fn columns_and_rows_tell_which_patches_are_of_incidence() {
    assert_eq!(value("Columns", [0, 1]), 2.0);
    assert_eq!(value("Columns", [2, 0]), 7.0);
    assert_eq!(value("Rows", [1, 0]), 2.0);
    assert_eq!(value("rows", [0, 2]), 7.0);
}

#[test]
fn the_header_is_told_as_it_stands() {
    let file = read_text(&document("Columns", &block("Reflection Back", COUNTING))).unwrap();
    let entry = |name: &str, value: &str| (name.to_owned(), value.to_owned());
    assert_eq!(
        file.header,
        [entry("Name", "blind"), entry("Thickness", "0.01 meter")]
    );
    assert_eq!(file.bands[0].name, "Visible");
    assert!(file.warnings.is_empty());
}

/// Light from the outside, `Front`, comes from below; it goes on in the direction of the same azimuth.
#[test]
fn front_is_below_and_straight_on_keeps_the_patch() {
    let text = document(
        "Columns",
        &block("Transmission Front", "1 0 0  0 2 0  0 0 3"),
    );
    let file = read_text(&text).unwrap();
    let table = two_sided(file.model().unwrap()).unwrap();
    // Patch 1 is centred on azimuth 0: light that travels towards +x comes from −x.
    let direction = |x: f64, z: f64| Direction::new(Vector::new(x, 0.0, z)).unwrap();
    let (wi, wo) = (direction(-0.8, -0.6), direction(0.8, 0.6));
    assert_eq!(table.value(wo, wi), 2.0);
    assert_eq!(table.value(wo, direction(0.8, -0.6)), 0.0);
    // The other way by reciprocity, with a warning.
    assert_eq!(table.value(wi, wo), 2.0);
    assert_eq!(
        file.warnings,
        ["Visible: transmission in one direction only: taken as reciprocal"]
    );
}

#[test]
fn what_was_mended_is_told() {
    let data = COUNTING.replace('4', "-4");
    let blocks = block("Reflection Back", &data) + &block("Reflection Back", COUNTING);
    let text = format!("Recover using: nothing\n{}", document("Columns", &blocks));
    assert_eq!(
        read_text(&text).unwrap().warnings,
        [
            "the file does not begin with XML; passed over lines: 1",
            "Reflection Back: -4 1/sr in line 4 is negative; values taken as 0: 1",
            "Visible: a block of reflection stands there twice; the last counts",
        ]
    );
}

#[test]
fn broken_files_are_refused_with_their_place() {
    let matrix = |data: &str| message(&document("Columns", &block("Reflection Back", data)));
    assert_eq!(
        matrix("1 2 3"),
        "line 3, column 21: Reflection Back: 9 values are needed, 3 were found"
    );
    assert_eq!(
        matrix("1 2 3 4 5 6 7 8 9 10"),
        "line 3, column 35: Reflection Back: 9 values are needed, 10 were found"
    );
    for bad in ["x", "NaN", "inf", "1e99"] {
        let expected = format!("line 3, column 19: expected a number, found {bad:?}");
        assert_eq!(matrix(&format!("1 {bad} 3")), expected);
    }
    assert_eq!(
        message("no xml"),
        "line 1, column 1: no XML here: neither <?xml nor <WindowElement"
    );
    let whole = document("Columns", &block("Reflection Back", COUNTING));
    assert!(message(&whole[..whole.len() - 10]).starts_with("line 4, column "));
    let told = |from: &str, to: &str| message(&whole.replacen(from, to, 1));
    assert!(told("BSDF", "IES").ends_with("expected the file type BSDF, found \"IES\""));
    assert!(
        told("Columns", "Colums").contains("expected Columns, Rows, TensorTree3 or TensorTree4")
    );
    assert!(told(">two</Row", ">three</Row").contains("angle basis \"three\" is neither defined"));
    assert!(told("Reflection Back", "Reflection").contains("Front or Back, found \"Reflection\""));
    assert!(
        told(">30</Lower", ">40</Lower")
            .contains("the upper bound of the ring before, found \"40\"")
    );
    assert!(told("<nPhis>2", "<nPhis>0").contains("a ring up to 90° with 0 patches"));
    let without = whole.replace("ScatteringData", "Data");
    assert!(message(&without).ends_with("<WavelengthDataBlock> has no <ScatteringData>"));
    let bytes = [whole.as_bytes(), b"\n\xff"].concat();
    let error = read(&bytes).unwrap_err().to_string();
    assert_eq!(
        error,
        "line 5, column 1: the file is not UTF-8 from here on"
    );
}

fn tree(data: &str) -> String {
    message(&document("TensorTree3", &block("Reflection Back", data)))
}

#[test]
fn broken_trees_are_refused_with_their_place() {
    assert_eq!(tree("{ 1 }"), "no fault");
    assert_eq!(tree("{ {1} {2} {3} {4} {5} {6} {7} {8}, }"), "no fault");
    for (data, expected) in [
        ("1", "column 17: expected { in the tensor tree, found 1"),
        (
            "{ 1 2 3 }",
            "column 17: Reflection Back: a grid of 3 values",
        ),
        (
            "{ 1",
            "column 20: expected } in the tensor tree, found the end",
        ),
        ("{ {1} {2} }", "expected { in the tensor tree, found }"),
        (
            "{1} {2}",
            "column 21: expected the end in the tensor tree, found {",
        ),
        ("{ a }", "column 19: expected a number, found \"a\""),
        ("{ }", "a grid of 0 values"),
    ] {
        assert!(tree(data).contains(expected), "{data}: {}", tree(data));
    }
    assert!(tree(&"{".repeat(100_000)).contains("halved more than 16 times"));
}
