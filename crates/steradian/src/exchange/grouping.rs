//! What is a row: a facet, an object or a material.

use super::facets::Facets;

/// How facets are put together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Grouping {
    /// Each by itself.
    #[default]
    Face,
    /// All of a shape.
    Object,
    /// All of a material.
    Material,
}

/// The surfaces that rows and columns stand for.
#[derive(Clone, Debug, PartialEq)]
pub struct Groups {
    names: Vec<String>,
    areas: Vec<f64>,
    of_facet: Vec<u32>,
}

impl Groups {
    /// Groups in the order of their first facets.
    pub fn new(facets: &Facets<'_>, grouping: Grouping) -> Self {
        let mut groups = Self {
            names: Vec::new(),
            areas: Vec::new(),
            of_facet: Vec::with_capacity(facets.count()),
        };
        let mut known = std::collections::HashMap::new();
        for (index, facet) in facets.list().iter().enumerate() {
            let part = facets.scene().parts()[facet.part.0 as usize];
            let material = if facet.is_back { part.back } else { part.front };
            let (key, name) = match grouping {
                Grouping::Face => ([index as u32, 0], facets.name(index)),
                Grouping::Object => (
                    [facet.shape.0, u32::from(facet.is_back)],
                    sided(facets.scene().shape_name(facet.shape), facet.is_back),
                ),
                Grouping::Material => (
                    [material.0, 0],
                    facets.scene().materials()[material.0 as usize].0.clone(),
                ),
            };
            let group = *known.entry(key).or_insert_with(|| {
                groups.names.push(name);
                groups.areas.push(0.0);
                groups.names.len() as u32 - 1
            });
            groups.areas[group as usize] += facet.area;
            groups.of_facet.push(group);
        }
        groups
    }

    /// Number of groups.
    pub fn count(&self) -> usize {
        self.names.len()
    }

    /// Their names.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Their areas in m².
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }

    /// The group of each facet.
    pub fn of_facet(&self) -> &[u32] {
        &self.of_facet
    }

    /// Whether every facet is a group.
    pub fn is_identity(&self) -> bool {
        self.count() == self.of_facet.len()
    }
}

fn sided(name: &str, is_back: bool) -> String {
    if is_back {
        format!("{name} back")
    } else {
        name.to_owned()
    }
}
