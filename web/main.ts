// Shows the page whose data the document has.

import type {PageData} from "./data/document";
import {showRespondPage} from "./pages/respond";
import {showSkinPage} from "./pages/skin";
import {showStudyPage} from "./pages/study";
import {showSweepPage} from "./pages/sweep";
import {showTransistorPage} from "./pages/transistor";

const pages: Record<string, (data: never) => void> = {respond: showRespondPage, skin: showSkinPage, study: showStudyPage, transistor: showTransistorPage, sweep: showSweepPage};

const data = JSON.parse(document.getElementById("data")!.textContent!) as PageData;
pages[data.page](data as never);
