//! The table as Parquet: whole numbers as INT64, numbers as DOUBLE, texts as UTF-8; what is missing is null.

use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::Result;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::Type;

use super::table::{Cell, Column, Columns, Kind, Row};

/// Rows that are written together.
const GROUP: usize = 100_000;

/// The whole file.
///
/// # Errors
/// None that a table can cause; the library's own are passed on.
pub fn bytes(columns: &Columns, rows: &[Row]) -> Result<Vec<u8>> {
    let fields = columns.all.iter().map(field).collect::<Result<Vec<_>>>()?;
    let schema = Type::group_type_builder("sweep").with_fields(fields).build()?;
    let mut file = Vec::new();
    let mut writer = SerializedFileWriter::new(&mut file, Arc::new(schema), Arc::new(WriterProperties::default()))?;
    for rows in rows.chunks(GROUP) {
        let mut group = writer.next_row_group()?;
        for (index, column) in columns.all.iter().enumerate() {
            let Some(mut writer) = group.next_column()? else { break };
            let cells = rows.iter().map(|row| &row.cells[index]);
            match column.kind {
                Kind::Whole => put::<Int64Type>(&mut writer, cells, whole)?,
                Kind::Number => put::<DoubleType>(&mut writer, cells, Cell::number)?,
                Kind::Text => put::<ByteArrayType>(&mut writer, cells, text)?,
            }
            writer.close()?;
        }
        group.close()?;
    }
    writer.close()?;
    Ok(file)
}

fn field(column: &Column) -> Result<Arc<Type>> {
    let (physical, logical) = match column.kind {
        Kind::Whole => (Physical::INT64, None),
        Kind::Number => (Physical::DOUBLE, None),
        Kind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
    };
    let field = Type::primitive_type_builder(&column.name, physical);
    field.with_repetition(Repetition::OPTIONAL).with_logical_type(logical).build().map(Arc::new)
}

/// A column's values, those that are missing told apart by their level.
fn put<'a, T: DataType>(
    writer: &mut SerializedColumnWriter<'_>,
    cells: impl Iterator<Item = &'a Cell> + Clone,
    value: impl Fn(&Cell) -> Option<T::T>,
) -> Result<()> {
    let levels: Vec<i16> = cells.clone().map(|cell| i16::from(value(cell).is_some())).collect();
    let values: Vec<T::T> = cells.filter_map(value).collect();
    writer.typed::<T>().write_batch(&values, Some(&levels), None)?;
    Ok(())
}

fn whole(cell: &Cell) -> Option<i64> {
    if let Cell::Whole(number) = cell { Some(*number) } else { None }
}

fn text(cell: &Cell) -> Option<ByteArray> {
    if let Cell::Text(text) = cell { Some(text.as_str().into()) } else { None }
}
