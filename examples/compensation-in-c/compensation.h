// SPDX-License-Identifier: Apache-2.0
/* Backlash and pitch error compensation of one channel: parameters 30a000..002 and 30a020..026, tables 70xxxx.
   A pure function of the setpoints and a small state; what it adds is positive in the positive direction. */
#ifndef COMPENSATION_H
#define COMPENSATION_H

#include <stddef.h>

#include "parameters.h"

enum { MAXIMUM_AXES = 9, STATE_PER_AXIS = 3 };

struct pitch_table {
  int enabled, bidirectional, modulo;
  double start, interval, factor; /* mm or deg, mm or deg, 1 */
  size_t points;                  /* of one direction */
  double *positive, *negative;    /* errors in mm or deg */
};

struct axis {
  double backlash, rate; /* mm or deg; mm or deg in one cycle */
  struct pitch_table pitch;
  double last, direction, added; /* the state: last setpoint, direction -1, 0 or 1, backlash added now */
};

struct compensation {
  struct axis axes[MAXIMUM_AXES];
  size_t count;
  int primed; /* the axes' positions are known */
};

/* Takes the parameters of `channel` over; the state is lost. Returns 0, or -1 when there is no memory. */
int compensation_configure(struct compensation *c, const trunnion_parameters_ParameterSet *set,
                           unsigned channel);
void compensation_free(struct compensation *c);
/* `rows` rows of `columns` setpoints. */
void compensation_process(struct compensation *c, const double *in, double *out, size_t rows, size_t columns);
/* STATE_PER_AXIS values for each axis, or none: nothing is known yet. */
void compensation_load(struct compensation *c, const double *values, size_t length);
size_t compensation_save(const struct compensation *c, double *values);

#endif
