// SPDX-License-Identifier: Apache-2.0
// Generated from libs/machine/alarms.yaml by tools/generate_docs.py.

/** Usual cause of an alarm and what the operator does, by its number. */
export const alarmCatalogue: Readonly<Record<number, { cause: string; remedy: string }>> = {
  100: {
    cause: "The process has ended, was killed or is blocked, or its host or network is lost",
    remedy: "Wait for the restart by the launcher, then reset the alarm; if it comes back, read the service's line in Diagnosis and its log",
  },
  101: {
    cause: "Services of different versions run in one cluster",
    remedy: "Install one version on every host, or replace the service by one with the same contract",
  },
  102: {
    cause: "One of two replicas has ended, is too slow or has not joined",
    remedy: "Motion continues with the other replica; the alarm ends when the lost one is in step again",
  },
  103: {
    cause: "A replica computes with a fault: memory, processor or a different program",
    remedy: "Keep a recording, check the versions of both replicas in Diagnosis, restart the service that differs, then reset",
  },
  104: {
    cause: "The parameters service does not respond or was restarted during a change",
    remedy: "Check the parameters service in Diagnosis, then reset the channel",
  },
  105: {
    cause: "The service finds a fault at every start, for example in its configuration",
    remedy: "Read the service's line in Diagnosis and its log, correct the cause, then reset the alarm",
  },
  107: {
    cause: "The files of the machine differ between the hosts",
    remedy: "Copy the same machine directory to every host and start the cluster again",
  },
  108: {
    cause: "The request came from another user, or for an executable outside the permitted directories",
    remedy: "Find out who sent it (swaps.jsonl); add the directory to swap_directories in machine.yaml if it is permitted",
  },
  109: {
    cause: "Two clusters use the same DDS domain",
    remedy: "Stop one of them, or give one another domain",
  },
  110: {
    cause: "A service of the stream or its computer is too slow, or has ended",
    remedy: "Reset the alarm and press cycle start; if it comes back, check the load of the computer and raise parameter 000900",
  },
  111: {
    cause: "The axis is blocked, overloaded or badly tuned, or its limit is too small",
    remedy: "Look for a collision or a hard-moving axis; then reset, and check the drive and the axis' limit of the following error",
  },
  112: {
    cause: "The axis was moved or started beyond its travel",
    remedy: "Reset the alarm and jog the axis back into its travel",
  },
  113: {
    cause: "A stage computed a jump of a position",
    remedy: "Do not move the axis; keep a recording, check compensation and kinematic parameters, then reset and reference the axis",
  },
  114: {
    cause: "The drive reports a fault of its own or was switched off",
    remedy: "Read the drive's display, remove the fault, then reset",
  },
  115: {
    cause: "The position of the axis is not certain after switching on or after damage of its file",
    remedy: "Do the reference return of the axis in mode REF",
  },
  116: {
    cause: "The home switch or the index pulse did not come within the travel",
    remedy: "Check switch, cable and the homing parameters of the axis, then repeat the reference return",
  },
  117: {
    cause: "The probe was switched on and touched something on the way, or its cable is faulty",
    remedy: "Reset, jog the probe away from the contact in the opposite direction, check its stylus, then measure again",
  },
  118: {
    cause: "The load encoder is mounted the wrong way round, has a wrong number of pulses or has lost some; or the axis slips",
    remedy: "Run `trunnion servo encoders` in semi-closed loop, correct sign and pulses (10a931, 10a932), then reset",
  },
  121: {
    cause: "Master and slave of a gantry are too far apart: load, friction, a lost position or a wrong reference coordinate",
    remedy: "Check the gantry mechanically; take the slave off (slave_off), jog the master until the error is small, couple again, then reset",
  },
  122: {
    cause: "One side of the gantry is blocked, or its drive is badly tuned",
    remedy: "Check both sides mechanically, compare their servo parameters, then reset",
  },
  123: {
    cause: "The drives work against each other: the sides are not square, or one moves hard",
    remedy: "Align the slave, check both sides mechanically and the rated currents (10a940), then reset",
  },
  130: {
    cause: "An emergency stop was pressed on the machine, the page or by the PLC",
    remedy: "Remove the danger, release the emergency stop, then reset; no axis moves by it",
  },
  131: {
    cause: "The logic of the machine has a fault: an endless loop, a division by zero or an index outside its array",
    remedy: "Correct the PLC program at the place in the text and start it again",
  },
  132: {
    cause: "The PLC refused the function, or its answer did not come in time",
    remedy: "Check what the function waits for (door, clamping, pressure, magazine), then reset and repeat the block",
  },
  133: {
    cause: "The PLC service has ended or does not answer",
    remedy: "Wait for its restart, then reset; check the service in Diagnosis if it comes back",
  },
  134: {
    cause: "An operator has forced inputs, outputs or variables of the PLC; the programs cannot change them",
    remedy: "Release them with 'trunnion plc force --release' when the test is over",
  },
  135: {
    cause: "The device is off, its cable or address is wrong, or it refuses a request; its inputs have their values for the loss of the connection",
    remedy: "Check the device, its cable and the address in modbus.yaml; when it answers again, reset",
  },
  140: {
    cause: "Position, work offset or tool length lead beyond the software limits (10a006, 10a007)",
    remedy: "Compare position and limits in the text; correct the program, the work offset or the tool length",
  },
  141: {
    cause: "The program was deleted, renamed or never stored",
    remedy: "Store the program, or select another one",
  },
  142: {
    cause: "The parameters describe no possible kinematic chain",
    remedy: "Correct the parameters 04c400 to 04c988, then reset the channel",
  },
  143: {
    cause: "A service is not active yet, or an axis has no reference",
    remedy: "Wait until the cluster is ready; the text names what is missing",
  },
  144: {
    cause: "The drives were switched off or a process ended while the program ran",
    remedy: "Remove the cause and press cycle start; after an emergency stop reset and start from the line that is offered",
  },
  145: {
    cause: "A kinematic parameter is infinite or not a number",
    remedy: "Correct the parameter in the text, then reset the channel",
  },
  146: {
    cause: "A direction of a rotary or linear axis has no length",
    remedy: "Enter the direction of the axis in the parameter in the text, then reset the channel",
  },
  147: {
    cause: "No two rotary axes differ in direction by 0.6 degrees",
    remedy: "Correct the directions of the rotary axes, then reset the channel",
  },
  148: {
    cause: "The length of a direction differs from 1 by more than 0.0001",
    remedy: "No action is necessary; enter a unit vector to end the warning",
  },
  149: {
    cause: "A compensation table has no range, too many values or values beyond its limits",
    remedy: "Correct the table in the text, then reset the channel",
  },
  150: {
    cause: "The disk is full, read-only or defective",
    remedy: "Make space on the disk or replace it; what was changed meanwhile is not stored",
  },
  151: {
    cause: "The program has a message for the operator",
    remedy: "Do what the message says, then press cycle start",
  },
  152: {
    cause: "A value of G10 or of a system variable is beyond its limits, or the table's service does not answer",
    remedy: "Correct the value in the line of the text, then start again",
  },
  153: {
    cause: "A power failure or a damaged disk",
    remedy: "Check the newest changes of the file in the text, then reset the alarm",
  },
  154: {
    cause: "The file and its previous generation are damaged",
    remedy: "Restore a backup, or enter the values again; then reset the alarm",
  },
  155: {
    cause: "The file of the program was damaged or changed outside the control",
    remedy: "Upload the program again",
  },
  160: {
    cause: "The order was not possible in this state or had a value beyond its limits",
    remedy: "Read the reason in the text; nothing was changed",
  },
  170: {
    cause: "The line is never reached, or lies inside a compensation or a curve that cannot be entered",
    remedy: "Choose an earlier line, or load the tool of the text by MDI and search again",
  },
  171: {
    cause: "The search has found the line",
    remedy: "Check that the approach is free, then press cycle start",
  },
  172: {
    cause: "The program service or the network is too slow",
    remedy: "Wait; motion continues as soon as the text arrives",
  },
  173: {
    cause: "The power failed or the cluster was stopped while a program ran",
    remedy: "Start the program from the line that is offered",
  },
  174: {
    cause: "The axis does not settle within its window: friction, load or too small a window",
    remedy: "Check the axis and the parameters of its exact stop; reset the alarm, then press cycle start",
  },
  175: {
    cause: "A move ahead leads two bodies of bodies.yaml within the clearance (collision: warn)",
    remedy: "Hold the feed; compare bodies, line and position in the text; correct the program, the tool table or bodies.yaml",
  },
  176: {
    cause: "A move would lead two bodies of bodies.yaml within the clearance (collision: stop)",
    remedy: "Jog away: moves that increase the distance are allowed. Correct the program, the tool table or bodies.yaml, then start, or start from the line in the text",
  },
  177: {
    cause: "bodies.yaml has an error, or does not fit the kinematic parameters; nothing moves while machine.yaml demands the check",
    remedy: "Correct the file in the text and start the machine again, or set 'collision: off' in machine.yaml",
  },
  483: {
    cause: "The drive of the other side of the gantry has stopped, and this one with it (10a943)",
    remedy: "Remove the cause at the axis of alarm 114, then reset",
  },
};
