//! Keys of schedules.

use steradian::quantity::Time;

use crate::scene_file::keys::{Key, Record, Value};
use crate::scene_file::value::Read;

const POINTS: Value = Value::List(&Value::TimeAndFactor);
pub const SCHEDULE: Value = Value::Either(&[POINTS, Value::Table(&SCHEDULE_TABLE)]);

pub const SCHEDULE_KEY: Key = Key::optional(
    "schedule",
    SCHEDULE,
    "How much of its light it gives in the course of time, straight lines between the points; always all unless given. \
     What `measure --duration` adds up and `measure --at` reads",
);

pub const SCHEDULE_TABLE: Record = Record {
    noun: "a schedule",
    keys: &[
        Key::one_of(
            "points",
            "linear",
            POINTS,
            "Points with straight lines between them",
        ),
        Key::one_of(
            "points",
            "held",
            POINTS,
            "Points whose factor holds until the next time; the last only ends the schedule unless it repeats",
        ),
        Key::optional(
            "period",
            Time::VALUE,
            "The points repeat after this time; without it nothing is known before the first and after the last",
        ),
    ],
};
