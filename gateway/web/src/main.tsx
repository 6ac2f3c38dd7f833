// SPDX-License-Identifier: Apache-2.0
import { render } from "preact";
import "uplot/dist/uPlot.min.css";
import "./style.css";
import "./state_bar.css";
import { readCyclePeriod } from "./state/cycle_period";
import { followPlan } from "./state/plan";
import { applyPreferences } from "./state/preferences";
import { connect } from "./state/store";
import { Page } from "./views/Page";

applyPreferences();
connect();
readCyclePeriod();
followPlan();
render(<Page />, document.getElementById("page")!);
