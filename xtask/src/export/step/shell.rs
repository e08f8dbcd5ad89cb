//! The model: faces with their edges and vertices, and the product around them.

use glam::DVec3;

use super::surface::{Curve, Surface};
use super::writer::{Id, Writer, quoted, real, references};

/// The whole file.
pub(super) fn text(name: &str, surfaces: &[Surface]) -> String {
    let mut writer = Writer::default();
    let size = surfaces.iter().map(Surface::size).fold(0.0, f64::max);
    let context = context(&mut writer, size);
    let mut shell = Shell {
        tolerance: Curve::tolerance(size),
        vertices: Vec::new(),
        edges: Vec::new(),
    };
    let faces: Vec<Id> = surfaces
        .iter()
        .map(|surface| shell.face(&mut writer, surface))
        .collect();
    let shell = writer.entity(&format!("OPEN_SHELL('',{})", references(&faces)));
    let model = writer.entity(&format!("SHELL_BASED_SURFACE_MODEL('',(#{shell}))"));
    product(&mut writer, name, model, context);
    let name = quoted(name);
    // A fixed date: the same model gives the same file.
    format!(
        "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('exact rational surfaces'),'2;1');\n\
         FILE_NAME({name},'1970-01-01T00:00:00',(''),(''),'xtask','xtask','');\n\
         FILE_SCHEMA(('AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF {{ 1 0 10303 442 1 1 4 }}'));\n\
         ENDSEC;\nDATA;\n{}ENDSEC;\nEND-ISO-10303-21;\n",
        writer.into_data()
    )
}

/// Vertices and edges that faces share.
struct Shell {
    tolerance: f64,
    vertices: Vec<(DVec3, Id)>,
    edges: Vec<(Curve, Id)>,
}

impl Shell {
    fn face(&mut self, writer: &mut Writer, surface: &Surface) -> Id {
        let geometry = writer.surface(surface);
        let mut sides = Vec::new();
        for (curve, forwards) in surface.boundary() {
            // A side that is a point (a pole) has no edge.
            if !curve.is_point(self.tolerance) {
                let (edge, same) = self.edge(writer, curve);
                let sense = if forwards == same { ".T." } else { ".F." };
                sides.push(writer.entity(&format!("ORIENTED_EDGE('',*,*,#{edge},{sense})")));
            }
        }
        let ring = writer.entity(&format!("EDGE_LOOP('',{})", references(&sides)));
        let bound = writer.entity(&format!("FACE_OUTER_BOUND('',#{ring},.T.)"));
        writer.entity(&format!("ADVANCED_FACE('',(#{bound}),#{geometry},.T.)"))
    }

    /// The edge along a curve, and whether it runs in the curve's direction.
    fn edge(&mut self, writer: &mut Writer, curve: Curve) -> (Id, bool) {
        let known = self
            .edges
            .iter()
            .find_map(|(known, id)| Some((*id, known.matches(&curve, self.tolerance)?)));
        if let Some(known) = known {
            return known;
        }
        let [start, end] = curve.ends().map(|point| self.vertex(writer, point));
        let geometry = writer.curve(&curve);
        let id = writer.entity(&format!("EDGE_CURVE('',#{start},#{end},#{geometry},.T.)"));
        self.edges.push((curve, id));
        (id, true)
    }

    fn vertex(&mut self, writer: &mut Writer, point: DVec3) -> Id {
        if let Some((_, id)) = self
            .vertices
            .iter()
            .find(|(known, _)| known.distance(point) <= self.tolerance)
        {
            return *id;
        }
        let place = writer.point(point);
        let id = writer.entity(&format!("VERTEX_POINT('',#{place})"));
        self.vertices.push((point, id));
        id
    }
}

/// Units: millimetres and radians; lengths are exact to a part of the model's size.
fn context(writer: &mut Writer, size: f64) -> Id {
    let length = writer.entity("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
    let angle = writer.entity("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
    let solid = writer.entity("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
    let exactness = real((1e-9 * size).max(1e-15));
    let uncertainty = writer.entity(&format!(
        "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE({exactness}),#{length},'distance_accuracy_value','')"
    ));
    writer.entity(&format!(
        "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#{uncertainty}))\
         GLOBAL_UNIT_ASSIGNED_CONTEXT((#{length},#{angle},#{solid}))REPRESENTATION_CONTEXT('',''))"
    ))
}

/// The product whose shape the model is.
fn product(writer: &mut Writer, name: &str, model: Id, context: Id) {
    let name = quoted(name);
    let application = writer.entity("APPLICATION_CONTEXT('managed model based 3d engineering')");
    writer.entity(&format!(
        "APPLICATION_PROTOCOL_DEFINITION('international standard',\
         'ap242_managed_model_based_3d_engineering',2014,#{application})"
    ));
    let product_context =
        writer.entity(&format!("PRODUCT_CONTEXT('',#{application},'mechanical')"));
    let product = writer.entity(&format!("PRODUCT({name},{name},'',(#{product_context}))"));
    let formation = writer.entity(&format!("PRODUCT_DEFINITION_FORMATION('','',#{product})"));
    let definition_context = writer.entity(&format!(
        "PRODUCT_DEFINITION_CONTEXT('part definition',#{application},'design')"
    ));
    let definition = writer.entity(&format!(
        "PRODUCT_DEFINITION('design','',#{formation},#{definition_context})"
    ));
    let shape = writer.entity(&format!("PRODUCT_DEFINITION_SHAPE('','',#{definition})"));
    let origin = writer.point(DVec3::ZERO);
    let placement = writer.entity(&format!("AXIS2_PLACEMENT_3D('',#{origin},$,$)"));
    let representation = writer.entity(&format!(
        "MANIFOLD_SURFACE_SHAPE_REPRESENTATION({name},(#{placement},#{model}),#{context})"
    ));
    writer.entity(&format!(
        "SHAPE_DEFINITION_REPRESENTATION(#{shape},#{representation})"
    ));
    writer.entity(&format!(
        "PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,(#{product}))"
    ));
}
