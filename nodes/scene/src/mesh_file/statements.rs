//! The lines of an OBJ file, strictly: every number is a number, every index names a vertex.

use glam::DVec3;

/// Statements that carry nothing this project uses.
const SKIPPED: [&str; 31] = [
    "vn",
    "vt",
    "vp",
    "g",
    "o",
    "s",
    "mg",
    "usemtl",
    "mtllib",
    "usemap",
    "maplib",
    "l",
    "p",
    "cstype",
    "deg",
    "bmat",
    "step",
    "curv",
    "curv2",
    "surf",
    "parm",
    "trim",
    "hole",
    "scrv",
    "sp",
    "end",
    "con",
    "bevel",
    "lod",
    "shadow_obj",
    "trace_obj",
];

const ACCEPTED: &str = "accepted: OBJ text with lines \"v x y z\" and \"f i j k\"";

/// Line, counted from 1, and what is wrong with it.
type Fault = (Option<usize>, String);

#[derive(Default)]
pub(super) struct Statements {
    pub(super) vertices: Vec<DVec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// Red, green, blue of each vertex, where its line has them.
    pub(super) colours: Vec<Option<[f64; 3]>>,
    pub(super) vertex_lines: Vec<u32>,
    pub(super) triangle_lines: Vec<u32>,
}

impl Statements {
    pub(super) fn read(text: &[u8]) -> Result<Statements, Fault> {
        if text.iter().all(u8::is_ascii_whitespace) {
            return Err((None, format!("the file is empty; {ACCEPTED}")));
        }
        let mut statements = Statements::default();
        // Faces may come before the vertices they name, so their indices are checked at the end.
        let mut faces: Vec<(u32, Vec<i64>, usize)> = Vec::new();
        for (line, statement) in logical_lines(text) {
            let fault = |message: String| (Some(line), message);
            let mut words = statement.split_ascii_whitespace();
            match words.next() {
                None => {}
                Some("v") => {
                    let (position, colour) = vertex(words).map_err(fault)?;
                    statements.vertices.push(position);
                    statements.colours.push(colour);
                    statements.vertex_lines.push(short(line));
                }
                Some("f") => {
                    let corners = face(words).map_err(fault)?;
                    faces.push((short(line), corners, statements.vertices.len()));
                }
                Some(word) if SKIPPED.contains(&word) => {}
                Some(word) => {
                    return Err(fault(format!("{:?} is no OBJ statement; {ACCEPTED}", shortened(word))));
                }
            }
        }
        if statements.vertices.is_empty() {
            return Err((None, format!("the file has no vertices; {ACCEPTED}")));
        }
        if faces.is_empty() {
            return Err((None, format!("the file has no faces; {ACCEPTED}")));
        }
        for (line, corners, vertices_so_far) in faces {
            statements.add_face(line, &corners, vertices_so_far)?;
        }
        Ok(statements)
    }

    /// A fan of triangles around the first corner.
    fn add_face(&mut self, line: u32, corners: &[i64], vertices_so_far: usize) -> Result<(), Fault> {
        let count = self.vertices.len();
        let absolute = |index: i64| {
            // Negative indices count back from the last vertex before the face.
            let from_zero =
                if index < 0 { vertices_so_far as i128 + i128::from(index) } else { i128::from(index) - 1 };
            usize::try_from(from_zero)
                .ok()
                .filter(|i| *i < count)
                .and_then(|i| u32::try_from(i).ok())
                .ok_or_else(|| {
                    let message = format!("face index {index} names no vertex; accepted: 1 to {count}");
                    (Some(line as usize), message)
                })
        };
        let first = absolute(corners[0])?;
        for pair in corners[1..].windows(2) {
            self.triangles.push([first, absolute(pair[0])?, absolute(pair[1])?]);
            self.triangle_lines.push(line);
        }
        Ok(())
    }
}

/// Lines without comments, continuation lines joined, with the number of their first line. Text that is not UTF-8 is
/// kept as far as it goes: names of groups may be in any encoding.
fn logical_lines(text: &[u8]) -> impl Iterator<Item = (usize, String)> + '_ {
    let mut lines = text.split(|byte| *byte == b'\n').enumerate();
    std::iter::from_fn(move || {
        let (number, bytes) = lines.next()?;
        let mut statement = without_comment(bytes);
        while statement.trim_ascii_end().ends_with('\\') {
            statement.truncate(statement.trim_ascii_end().len() - 1);
            match lines.next() {
                Some((_, more)) => statement.push_str(&without_comment(more)),
                None => break,
            }
        }
        Some((number + 1, statement))
    })
}

fn without_comment(line: &[u8]) -> String {
    let statement = line.split(|byte| *byte == b'#').next().unwrap_or_default();
    String::from_utf8_lossy(statement).into_owned()
}

/// `x y z`, then possibly a weight, which is not used, or red, green and blue.
fn vertex<'a>(words: impl Iterator<Item = &'a str>) -> Result<(DVec3, Option<[f64; 3]>), String> {
    let mut numbers = [0.0; 6];
    let mut count = 0;
    for word in words {
        let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
        let Some(number) = number else {
            return Err(format!(
                "vertex coordinate {:?} is not accepted; accepted: a finite number",
                shortened(word)
            ));
        };
        if let Some(place) = numbers.get_mut(count) {
            *place = number;
        }
        count += 1;
    }
    match count {
        3.. => {
            let [x, y, z, red, green, blue] = numbers;
            Ok((DVec3::new(x, y, z), (count == 6).then_some([red, green, blue])))
        }
        _ => Err(format!("a vertex with {count} coordinates; accepted: v x y z")),
    }
}

/// `i`, `i/t`, `i//n` or `i/t/n` for each corner; only `i` is used.
fn face<'a>(words: impl Iterator<Item = &'a str>) -> Result<Vec<i64>, String> {
    let corners = words
        .map(|word| {
            let index = word.split('/').next().unwrap_or_default();
            index.parse::<i64>().map_err(|_| {
                format!(
                    "face corner {:?} is not accepted; accepted: a vertex number counted from 1",
                    shortened(word)
                )
            })
        })
        .collect::<Result<Vec<i64>, String>>()?;
    match corners.len() {
        3.. => Ok(corners),
        count => Err(format!("a face with {count} corners; accepted: three or more")),
    }
}

fn shortened(word: &str) -> String {
    word.chars().take(40).collect()
}

fn short(line: usize) -> u32 {
    u32::try_from(line).unwrap_or(u32::MAX)
}
