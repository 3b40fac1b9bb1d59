use super::folder;
