//! Do the error bars tell the truth? How often intervals hold the value that they are about: of integrands with closed forms, and of readings in rooms.

mod integrands;
mod rooms;
mod thrown;
