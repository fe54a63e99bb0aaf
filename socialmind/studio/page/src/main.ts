import { mount } from "svelte";
import App from "./App.svelte";
import "./studio.css";

// The token has been taken as a cookie; in the address others could read it.
if (location.search) history.replaceState(null, "", location.pathname + location.hash);

mount(App, { target: document.body });
