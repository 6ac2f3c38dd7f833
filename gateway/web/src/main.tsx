// SPDX-License-Identifier: Apache-2.0
import { render } from "preact";
import "uplot/dist/uPlot.min.css";
import "./style.css";
import { connect } from "./state/store";
import { Page } from "./views/Page";

connect();
render(<Page />, document.getElementById("page")!);
