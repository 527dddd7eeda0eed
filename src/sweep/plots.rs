//! The plots of a sweep: those a plan asks for, or those that suit its points; for each scenario its own.

use super::plan::{Drawn, Plan};
use super::points::Points;
use super::table::{Cell, Columns, Kind, Row};
use crate::output::numbers::counted;
use crate::plot::{Axis, Figure, HeatMap, Look, Point, Series, svg};
use crate::report::format::significant;

/// As many different numbers as an axis shows one by one when they are not those of a grid.
const MOST_LEVELS: usize = 24;
/// Curves that can be told apart.
const MOST_CURVES: usize = 6;
/// Of a number that tells curves apart and has too many values: so many ranges.
const RANGES: usize = 4;

/// Every plot with the name of its file.
#[must_use]
pub fn of(plan: &Plan, columns: &Columns, rows: &[Row]) -> Vec<(String, String)> {
    let plots = plan.plots.clone().unwrap_or_else(|| usual(plan, columns));
    let mut drawn = Vec::new();
    let scenarios = scenarios(columns, rows);
    for scenario in &scenarios {
        let rows: Vec<&Row> = rows.iter().filter(|row| text(columns, row, "scenario") == *scenario).collect();
        let is_only = scenarios.iter().filter(|other| stem(other) == stem(scenario)).count() == 1;
        let name = if is_only { stem(scenario) } else { scenario }.to_owned();
        let table = Table { plan, columns, rows, name };
        drawn.extend(plots.iter().map(|plot| (table.file(plot), svg::svg(&table.draw(plot)))));
    }
    drawn
}

/// What suits the points: a heat map where two numbers vary, curves where one does.
fn usual(plan: &Plan, columns: &Columns) -> Vec<Drawn> {
    let value = plan.read.first().cloned().unwrap_or_else(|| "kinetic_energy".to_owned());
    let varies = |axis: &&super::axis::Axis| axis.range().is_some_and(|(from, to)| from < to) || axis.values.len() > 1;
    let name = |axis: &super::axis::Axis| columns.heading(&axis.name).to_owned();
    let (numbers, words): (Vec<_>, Vec<_>) = plan.vary.iter().filter(varies).partition(|axis| axis.is_numeric());
    match numbers.as_slice() {
        [] => Vec::new(),
        [x] => vec![Drawn::Curves { x: name(x), y: vec![value], by: words.first().map(|axis| name(axis)) }],
        [x, y, ..] => vec![Drawn::HeatMap { x: name(x), y: name(y), value }],
    }
}

fn scenarios(columns: &Columns, rows: &[Row]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for row in rows {
        let name = text(columns, row, "scenario");
        if names.last() != Some(&name) {
            names.push(name);
        }
    }
    names
}

/// The file's name without folders and extension.
fn stem(scenario: &str) -> &str {
    let name = scenario.rsplit('/').next().unwrap_or(scenario);
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

fn text(columns: &Columns, row: &Row, name: &str) -> String {
    columns.position(name).map_or(Cell::Missing, |at| row.cells[at].clone()).text()
}

/// The rows of one scenario.
struct Table<'a> {
    plan: &'a Plan,
    columns: &'a Columns,
    rows: Vec<&'a Row>,
    /// What its plots call it.
    name: String,
}

impl Table<'_> {
    fn file(&self, plot: &Drawn) -> String {
        let (value, others): (String, Vec<&String>) = match plot {
            Drawn::HeatMap { x, y, value } => (value.clone(), vec![x, y]),
            Drawn::Curves { x, y, by } => (y.join("_"), std::iter::once(x).chain(by).collect()),
        };
        let mut name = format!("{} {value} over", self.name.trim_start_matches(['.', '/']));
        others.iter().for_each(|other| name += &format!(" {other}"));
        let safe = |c: char| if c.is_alphanumeric() || c == '.' { c } else { '_' };
        name.chars().map(safe).collect::<String>() + ".svg"
    }

    fn draw(&self, plot: &Drawn) -> crate::plot::Drawing {
        match plot {
            Drawn::HeatMap { x, y, value } => self.heat_map(x, y, value).draw(),
            Drawn::Curves { x, y, by } => self.curves(x, y, by.as_deref()).draw(),
        }
    }

    fn heat_map(&self, x: &str, y: &str, value: &str) -> HeatMap {
        let [across, up] = [x, y].map(|name| self.bins(name));
        let mut means = vec![Mean::default(); across.count() * up.count()];
        for row in &self.rows {
            let place = self.number(row, x).zip(self.number(row, y));
            let Some((x, y)) = place else { continue };
            let Some((column, line)) = across.find(x).zip(up.find(y)) else { continue };
            means[line * across.count() + column].add(self.number(row, value));
        }
        HeatMap {
            title: format!("{}: {}", self.name, self.bare(value)),
            subtitle: self.subtitle("a cell", &means),
            x: self.label(x),
            y: self.label(y),
            value: self.label(value),
            x_edges: across.edges,
            y_edges: up.edges,
            cells: means.iter().map(Mean::get).collect(),
        }
    }

    fn curves(&self, x: &str, y: &[String], by: Option<&str>) -> Figure {
        let bins = self.bins(x);
        let groups = by.map_or_else(|| vec![(String::new(), self.rows.clone())], |by| self.groups(by));
        let (mut series, mut counted) = (Vec::new(), Vec::new());
        for (group, rows) in &groups {
            for value in y {
                let mut means = vec![Mean::default(); bins.count()];
                for row in rows {
                    if let Some(bin) = self.number(row, x).and_then(|number| bins.find(number)) {
                        means[bin].add(self.number(row, value));
                    }
                }
                let mut name = group.clone();
                if y.len() > 1 || group.is_empty() {
                    name = [&self.bare(value), group].map(String::as_str).join(" ").trim_end().to_owned();
                }
                let points = means.iter().zip(&bins.middles);
                let points = points.filter_map(|(mean, x)| Some(Point { x: *x, y: mean.get()?, label: None }));
                series.push(Series { name, look: Look(series.len()), joined: true, points: points.collect() });
                counted.extend(means);
            }
        }
        let names: Vec<String> = y.iter().map(|value| self.bare(value)).collect();
        Figure {
            title: format!("{}: {}", self.name, names.join(", ")),
            subtitle: self.subtitle("a point", &counted),
            x: Axis::linear(self.label(x)),
            y: Axis::linear(y.first().map_or_else(String::new, |value| self.label(value))),
            series,
        }
    }

    /// Rows by what stands in a column, in its order.
    fn groups(&self, by: &str) -> Vec<(String, Vec<&Row>)> {
        let mut values: Vec<(Option<f64>, String)> =
            self.rows.iter().map(|row| (self.number(row, by), text(self.columns, row, by))).collect();
        values.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
        values.dedup();
        let name = self.bare(by);
        if values.len() <= MOST_CURVES || values.iter().any(|(number, _)| number.is_none()) {
            let rows =
                |value: &str| self.rows.iter().copied().filter(|row| text(self.columns, row, by) == value).collect();
            let shown = |(number, text): &(Option<f64>, String)| number.map_or_else(|| text.clone(), significant);
            return values.iter().map(|value| (format!("{name} {}", shown(value)), rows(&value.1))).collect();
        }
        let bins = Bins::even(values.iter().filter_map(|(number, _)| *number), RANGES);
        let within = |bin: usize| {
            let is_in = |row: &&&Row| self.number(row, by).and_then(|number| bins.find(number)) == Some(bin);
            self.rows.iter().filter(is_in).copied().collect()
        };
        let range =
            |bin: usize| format!("{name} {}–{}", significant(bins.edges[bin]), significant(bins.edges[bin + 1]));
        (0..bins.count()).map(|bin| (range(bin), within(bin))).collect()
    }

    /// The numbers of a column: one by one where that can be drawn, else in ranges.
    fn bins(&self, name: &str) -> Bins {
        let numbers = || self.rows.iter().filter_map(|row| self.number(row, name));
        let mut levels: Vec<f64> = numbers().collect();
        levels.sort_by(f64::total_cmp);
        levels.dedup();
        let is_grid = self.plan.points == Points::Grid
            && self.plan.vary.iter().any(|axis| self.columns.heading(&axis.name) == name);
        if is_grid || levels.len() <= MOST_LEVELS {
            return Bins::of(levels);
        }
        let count = (self.rows.len() as f64).sqrt() as usize;
        Bins::even(levels.into_iter(), count.clamp(4, MOST_LEVELS))
    }

    fn number(&self, row: &Row, name: &str) -> Option<f64> {
        row.cells[self.columns.position(name)?].number()
    }

    /// The name of a column for people.
    fn bare(&self, name: &str) -> String {
        match name {
            "mu_l" => "μ_L".to_owned(),
            "mu_a" => "μ_A".to_owned(),
            "epsilon" => "ε".to_owned(),
            _ => name.replace('_', " "),
        }
    }

    fn label(&self, name: &str) -> String {
        let column = self.columns.position(name).map(|at| &self.columns.all[at]);
        let unit = column.and_then(|column| column.unit.clone());
        unit.map_or_else(|| self.bare(name), |unit| format!("{} [{unit}]", self.bare(name)))
    }

    /// Of how many runs each thing drawn is the mean, and what else varied.
    fn subtitle(&self, each: &str, means: &[Mean]) -> String {
        let (least, most) = means.iter().fold((usize::MAX, 0), |(low, high), m| (low.min(m.count), high.max(m.count)));
        let runs = counted(self.rows.len(), "run", "runs");
        let mut told = match (least, most) {
            (_, 0) => format!("{runs}, none of which tells this"),
            (1, 1) => format!("{runs}, one {each}"),
            (least, most) if least == most => format!("{runs}, the mean of {most} {each}"),
            (least, most) => format!("{runs}, the mean of {least} to {most} {each}"),
        };
        let errors = self.rows.iter().filter(|row| row.is_error()).count();
        if errors > 0 {
            told += &format!("; {errors} ended in an error and are left out");
        }
        told
    }
}

/// Whether a plot can be drawn over a column, or of it.
#[must_use]
pub fn is_numeric(columns: &Columns, name: &str) -> bool {
    columns.position(name).is_some_and(|at| columns.all[at].kind != Kind::Text)
}

/// Sum and count.
#[derive(Clone, Copy, Debug, Default)]
struct Mean {
    sum: f64,
    count: usize,
}

impl Mean {
    fn add(&mut self, number: Option<f64>) {
        if let Some(number) = number {
            self.sum += number;
            self.count += 1;
        }
    }

    fn get(&self) -> Option<f64> {
        (self.count > 0).then(|| self.sum / self.count as f64)
    }
}

/// Ranges side by side.
#[derive(Clone, Debug, PartialEq)]
struct Bins {
    /// One more than there are ranges.
    edges: Vec<f64>,
    /// Where a range is drawn.
    middles: Vec<f64>,
}

impl Bins {
    /// A range around each of some rising numbers, which meets the next half way.
    fn of(levels: Vec<f64>) -> Self {
        let gap = |a: usize, b: usize| match (levels.get(a), levels.get(b)) {
            (Some(a), Some(b)) if a != b => b - a,
            _ => 1.0,
        };
        let [Some(first), Some(last)] = [levels.first(), levels.last()] else {
            return Bins { edges: vec![0.0], middles: levels };
        };
        let low = first - 0.5 * gap(0, 1);
        let high = last + 0.5 * gap(levels.len().saturating_sub(2), levels.len() - 1);
        let between = levels.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        Bins { edges: std::iter::once(low).chain(between).chain([high]).collect(), middles: levels }
    }

    /// Equal ranges from the least number to the greatest.
    fn even(numbers: impl Iterator<Item = f64>, count: usize) -> Self {
        let (low, high) = numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), n| (l.min(n), h.max(n)));
        let edge = |place: usize| low + (high - low) * (place as f64 / count as f64);
        let edges: Vec<f64> = (0..=count).map(edge).collect();
        Bins { middles: edges.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect(), edges }
    }

    fn count(&self) -> usize {
        self.middles.len()
    }

    /// The range a number falls into; the last one has its end too.
    fn find(&self, number: f64) -> Option<usize> {
        let inside = self.edges.first().is_some_and(|low| *low <= number);
        let place = self.edges.partition_point(|edge| *edge <= number);
        let place = place.saturating_sub(1).min(self.count().saturating_sub(1));
        (inside && self.edges.last().is_some_and(|high| number <= *high)).then_some(place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_meet_half_way_and_hold_their_numbers() {
        let bins = Bins::of(vec![1.0, 2.0, 4.0]);
        assert_eq!(bins.edges, [0.5, 1.5, 3.0, 5.0]);
        assert_eq!([1.0, 2.0, 4.0].map(|number| bins.find(number)), [Some(0), Some(1), Some(2)]);
        assert_eq!((bins.find(0.0), bins.find(5.5)), (None, None));
        let even = Bins::even([0.0, 10.0].into_iter(), 4);
        assert_eq!([0.0, 2.6, 10.0].map(|number| even.find(number)), [Some(0), Some(1), Some(3)]);
        assert_eq!(Bins::of(Vec::new()).find(1.0), None);
    }
}
