import { render } from "preact";
import "uplot/dist/uPlot.min.css";
import "./style.css";
import { connect } from "./state/store";
import { Page } from "./views/Page";

connect();
render(<Page />, document.getElementById("page")!);
